// Empty: CMakeLists.txt compiles the headers that tests share in the name of this file.
