# The packages of a build for the browser: headers of the system, and the libraries that build makes. The system's
# headers are linked into a folder of their own, away from those of its C library.
set(HBVM_BROWSER_LIBRARIES "" CACHE PATH "Where src/browser/build put its libraries")
if(NOT EXISTS ${HBVM_BROWSER_LIBRARIES}/lib/libmpfr.a)
  message(FATAL_ERROR "HBVM_BROWSER_LIBRARIES holds no libraries: run src/browser/build, which builds them")
endif()
set(borrowed ${CMAKE_BINARY_DIR}/borrowed)
file(MAKE_DIRECTORY ${borrowed})
foreach(name boost eigen3/Eigen eigen3/unsupported fmt toml++ CLI nlohmann)
  cmake_path(GET name FILENAME folder)
  if(NOT EXISTS /usr/include/${name})
    message(FATAL_ERROR "/usr/include/${name} is missing: studies/run --build installs it")
  endif()
  file(CREATE_LINK /usr/include/${name} ${borrowed}/${folder} SYMBOLIC)
endforeach()
add_library(hbvm_borrowed INTERFACE)
target_include_directories(hbvm_borrowed SYSTEM INTERFACE ${borrowed} ${HBVM_BROWSER_LIBRARIES}/include)
foreach(package Boost::headers Eigen3::Eigen nlohmann_json::nlohmann_json CLI11::CLI11 Threads::Threads fmt::fmt
                tomlplusplus::tomlplusplus)
  add_library(${package} INTERFACE IMPORTED GLOBAL)
  target_link_libraries(${package} INTERFACE hbvm_borrowed)
endforeach()
target_compile_definitions(fmt::fmt INTERFACE FMT_HEADER_ONLY=1)
foreach(library mpfr gmp flint md4c)
  string(TOUPPER ${library}_LIBRARY variable)
  set(${variable} ${HBVM_BROWSER_LIBRARIES}/lib/lib${library}.a)
endforeach()
set(BALL_LIBRARIES ${FLINT_LIBRARY})
set(HBVM_QUAD OFF)

# With vectors of two numbers and sixteen of them at hand, as on x86-64, Eigen adds in the same order as there, and so
# every digit is the same. It writes instructions of x86 for GCC before 6.3, and others for GCC from 6.0 on: 5.13, which
# there is not, is taken for neither. Whole numbers of 64 bits are also read as two of 32.
add_compile_options(-msimd128 -msse2 -DEIGEN_ARCH_DEFAULT_NUMBER_OF_REGISTERS=16 -fgnuc-version=5.13.0
                    -fwasm-exceptions -fno-strict-aliasing -isystem ${CMAKE_CURRENT_LIST_DIR}/library
                    "$<$<COMPILE_LANGUAGE:CXX>:SHELL:-include ${CMAKE_CURRENT_LIST_DIR}/library/missing.h>")
add_link_options(-fwasm-exceptions)
