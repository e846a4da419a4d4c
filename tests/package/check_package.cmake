# Installs what is built, moves it to prove that it does not remember where it was, and lets
# examples/library find it, build against it, and run. The installed program draws, too.

# run(COMMAND ...): what it printed is in `printed`.
macro(run)
    execute_process(COMMAND ${ARGN} OUTPUT_VARIABLE printed ERROR_VARIABLE complaints
        RESULT_VARIABLE outcome)
    if(NOT outcome EQUAL 0)
        message(FATAL_ERROR "${outcome} from ${ARGN}\n${printed}\n${complaints}")
    endif()
endmacro()

function(expect_match text pattern)
    if(NOT text MATCHES "${pattern}")
        message(FATAL_ERROR "expected ${pattern} in:\n${text}")
    endif()
endfunction()

function(expect_file path)
    if(NOT EXISTS "${path}")
        message(FATAL_ERROR "${path} was not written")
    endif()
endfunction()

function(configure_outside from to)
    run("${CMAKE_COMMAND}" -S "${from}" -B "${to}" -G "${generator}" -D CMAKE_BUILD_TYPE=Release
        "-DCMAKE_CXX_COMPILER=${compiler}" "-DCMAKE_PREFIX_PATH=${prefix}"
        "-DCMAKE_CXX_FLAGS=${warnings}")
endfunction()

file(REMOVE_RECURSE "${scratch}")
set(prefix "${scratch}/a place")
run("${CMAKE_COMMAND}" --install "${build}" --prefix "${scratch}/first")
file(RENAME "${scratch}/first" "${prefix}")

configure_outside("${example}" "${scratch}/outside")
run("${CMAKE_COMMAND}" --build "${scratch}/outside")
run("${scratch}/outside/light_a_room" "${scratch}/room.pfm")
expect_match("${printed}" "table: [1-9][0-9]* lux")
expect_match("${printed}" "energy: 4000.0 lm emitted, (4000|399[0-9]).[0-9] lm absorbed, 0.0 lm escaped")
expect_file("${scratch}/room.pfm")

# Each installed header finds what it includes.
file(GLOB_RECURSE headers RELATIVE "${prefix}/include/patchlight" "${prefix}/include/patchlight/*.h")
list(TRANSFORM headers REPLACE "(.+)" "#include \"\\1\"\n")
string(CONCAT source ${headers})
file(WRITE "${scratch}/headers/all.cpp" "${source}")
file(WRITE "${scratch}/headers/CMakeLists.txt" [[
cmake_minimum_required(VERSION 3.25)
project(headers LANGUAGES CXX)
find_package(patchlight REQUIRED)
add_library(headers OBJECT all.cpp)
target_link_libraries(headers PRIVATE patchlight::solver patchlight::raster)
]])
configure_outside("${scratch}/headers" "${scratch}/headers/build")
run("${CMAKE_COMMAND}" --build "${scratch}/headers/build")

# The program draws with the image module that was installed with it.
expect_file("${prefix}/${libdir}/patchlight/patchlight_image.so")
run("${prefix}/bin/patchlight" --version)
string(REPLACE "." "\\." dotted "${version}")
expect_match("${printed}" "${dotted}")
run("${prefix}/bin/patchlight" solve "${example}/../cornell_box.json"
    --image "${scratch}/box.png" --stats "${scratch}/box.json" --quiet)
expect_file("${scratch}/box.png")
expect_file("${scratch}/box.json")
