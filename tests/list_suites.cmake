# Writes `listed`, a file for ctest: one test for each suite of `program`, named prefix.Suite. One
# process for each of 1,700 tests would start more than it tests.
execute_process(COMMAND "${program}" --gtest_list_tests OUTPUT_VARIABLE lines RESULT_VARIABLE outcome)
if(NOT outcome EQUAL 0)
    message(FATAL_ERROR "${outcome} from ${program}\n${lines}")
endif()
string(REGEX MATCHALL "(^|\n)[^ \n]+\\.( |\n)" suites "${lines}")
set(tests)
foreach(suite IN LISTS suites)
    string(REGEX REPLACE "[ \n]" "" suite "${suite}")
    string(REGEX REPLACE "\\.$" "" name "${suite}")
    string(APPEND tests
        "add_test([==[${prefix}.${name}]==] [==[${program}]==] --gtest_brief=1 [==[--gtest_filter=${suite}*]==])\n"
        "set_tests_properties([==[${prefix}.${name}]==] PROPERTIES COST ${cost})\n")
endforeach()
file(WRITE "${listed}" "${tests}")
