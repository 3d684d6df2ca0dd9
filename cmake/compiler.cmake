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

# Code that passes packs of lanes through memory copies them as a whole: of two halves, as GCC copies structures, a load of the
# whole waits for both to reach the cache. Said for the files that gain by it: where Real is a double, it costs the update a
# quarter, and the gas was no faster.
include(CheckCXXCompilerFlag)
set(BRISANCE_WHOLE_PACKS -mmove-max=512 -mstore-max=512)
check_cxx_compiler_flag("${BRISANCE_WHOLE_PACKS}" BRISANCE_COPIES_WHOLE_PACKS)
if(NOT BRISANCE_COPIES_WHOLE_PACKS)
  set(BRISANCE_WHOLE_PACKS "")
endif()

# Warnings concern our own code only, so they are not exported.
add_library(brisance_warnings INTERFACE)
target_compile_options(brisance_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
                                                   $<$<BOOL:${BRISANCE_WARNINGS_AS_ERRORS}>:-Werror>)

find_program(CCACHE ccache)
if(CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
endif()
