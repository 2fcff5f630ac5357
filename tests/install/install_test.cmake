# Builds the README's example in a folder of its own (WORK), with the compiler CXX and the FLAGS of the library (without
# those of its sanitizers it would not link), by one ROUTE to it:
#   find_package      installed from BUILD, found by CMake
#   pkg_config        installed from BUILD, found by pkg-config
#   add_subdirectory  the SOURCE as a part of the project: the example is compiled against it; the library itself would
#                     be compiled once more, unless WHOLE is set
file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
file(COPY ${SOURCE}/tests/install/CMakeLists.txt DESTINATION ${WORK}/project)
configure_file(${SOURCE}/studies/library/run.cpp ${WORK}/project/example.cpp COPYONLY)

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY OUTPUT_VARIABLE output COMMAND_ECHO STDOUT)
  message("${output}")
  set(output "${output}" PARENT_SCOPE)
endfunction()

if(ROUTE STREQUAL add_subdirectory)
  run(${CMAKE_COMMAND} -G Ninja -S ${WORK}/project -B ${WORK}/build -DHBVM_SOURCE=${SOURCE} -DCMAKE_CXX_COMPILER=${CXX}
      "-DCMAKE_CXX_FLAGS=${FLAGS}" -DCMAKE_EXPORT_COMPILE_COMMANDS=ON)
  if(NOT WHOLE)
    # By its own command: the build would first make what the library is generated from.
    file(READ ${WORK}/build/compile_commands.json commands)
    string(JSON last LENGTH "${commands}")
    math(EXPR last "${last} - 1")
    foreach(i RANGE ${last})
      string(JSON file GET "${commands}" ${i} file)
      if(file STREQUAL ${WORK}/project/example.cpp)
        string(JSON command GET "${commands}" ${i} command)
      endif()
    endforeach()
    if(NOT command)
      message(FATAL_ERROR "the project does not compile example.cpp")
    endif()
    file(MAKE_DIRECTORY ${WORK}/build/CMakeFiles/example.dir)
    run(${CMAKE_COMMAND} -E chdir ${WORK}/build sh -c "${command}")
    return()
  endif()
else()
  run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/installed)
  if(NOT EXISTS ${WORK}/installed/share/bash-completion/completions/hbvm)
    message(FATAL_ERROR "the completion is not installed")
  endif()
  file(GLOB_RECURSE package ${WORK}/installed/*.pc)
  cmake_path(GET package PARENT_PATH package_folder)
endif()
if(ROUTE STREQUAL pkg_config)
  run(${CMAKE_COMMAND} -E env PKG_CONFIG_PATH=${package_folder} pkg-config --cflags --libs hbvm)
  separate_arguments(flags UNIX_COMMAND "${FLAGS} ${output}")
  file(MAKE_DIRECTORY ${WORK}/build)
  run(${CXX} ${WORK}/project/example.cpp -o ${WORK}/build/example ${flags})
else()
  if(ROUTE STREQUAL find_package)
    run(${CMAKE_COMMAND} -G Ninja -S ${WORK}/project -B ${WORK}/build -DCMAKE_PREFIX_PATH=${WORK}/installed
        -DCMAKE_CXX_COMPILER=${CXX} "-DCMAKE_CXX_FLAGS=${FLAGS}")
  endif()
  run(${CMAKE_COMMAND} --build ${WORK}/build --target example)
endif()

run(${WORK}/build/example)
if(NOT output MATCHES "energy error [0-9.]+e-1[0-9], x")
  message(FATAL_ERROR "the example printed '${output}'")
endif()
