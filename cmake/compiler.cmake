# One interface target carries the language level, the instruction set and the warnings to every target.
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

add_library(brisance_compiler INTERFACE)
target_compile_features(brisance_compiler INTERFACE cxx_std_20)
# Results do not depend on how the compiler contracts a*b+c; errno is not needed; NaN stays NaN (never -ffast-math).
target_compile_options(brisance_compiler INTERFACE -ffp-contract=off -fno-math-errno)
if(BRISANCE_INSTRUCTION_SET)
  target_compile_options(brisance_compiler INTERFACE -march=${BRISANCE_INSTRUCTION_SET})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(brisance_compiler INTERFACE -mprefer-vector-width=512)
  endif()
endif()

# Warnings concern our own code only, so they are not exported.
add_library(brisance_warnings INTERFACE)
target_compile_options(brisance_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
                                                   $<$<BOOL:${BRISANCE_WARNINGS_AS_ERRORS}>:-Werror>)

find_program(CCACHE ccache)
if(CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
endif()
