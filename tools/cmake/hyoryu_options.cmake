# Compiler settings of every target: C++20, warnings as errors, and floating point that gives the
# same bits on every run of one binary.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()

add_library(hyoryu_options INTERFACE)
target_compile_options(hyoryu_options INTERFACE
  -Wall -Wextra -Wconversion -Wpedantic $<$<BOOL:${HYORYU_STRICT}>:-Werror>
  # Members left out of a designated initialiser take their defaults; that is the point of them.
  -Wno-missing-field-initializers
  # In C++ GCC leaves these out of -Wconversion, as Eigen counts with signs and the standard library without.
  $<$<CXX_COMPILER_ID:Clang>:-Wno-sign-conversion>
  # GCC 12 takes the vectorised tail of Eigen's three-vectors for reads and writes past their end.
  $<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds;-Wno-stringop-overflow;-Wno-stringop-overread>
  # Its own AVX-512 intrinsics begin from registers left undefined on purpose, and it warns of them.
  $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>
  # Contraction would let the compiler round one formula differently in two places that must agree
  # (a pair seen from i and from j), so it is off.
  -ffp-contract=off
  # sqrt and divisions need neither errno nor traps; without these two the pair loops stay scalar.
  -fno-math-errno -fno-trapping-math
  # A pack wider than the registers of the target is split by the compiler; its note on that says
  # that libraries built with other flags could not exchange packs, which no interface does.
  -Wno-psabi)
# Files that are compiled together see each other's constants, which names within functions may repeat.
if(NOT HYORYU_UNITY)
  target_compile_options(hyoryu_options INTERFACE -Wshadow)
else()
  target_compile_options(hyoryu_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wshadow=local>)
endif()
if(HYORYU_NATIVE)
  # Of a processor with AVX10 Clang says how it combines the instruction sets, which no source can change.
  target_compile_options(hyoryu_options INTERFACE -march=native
    $<$<CXX_COMPILER_ID:Clang>:-Wno-invalid-feature-combination>)
endif()
if(HYORYU_SANITIZE)
  # The code that sanitizers add leads GCC to warn of what it put there itself. Two kinds of undefined
  # behaviour are left out that the address sanitizer sees, too: they cost a third of the build.
  target_compile_options(hyoryu_options INTERFACE
    -fsanitize=${HYORYU_SANITIZE} -fno-sanitize=null,object-size -fno-sanitize-recover=all
    -fno-omit-frame-pointer $<$<CXX_COMPILER_ID:GNU>:-Wno-error>)
  target_link_options(hyoryu_options INTERFACE -fsanitize=${HYORYU_SANITIZE})
endif()
if(HYORYU_FUZZER) # what it counts, in all we compile; what drives it, in its targets alone
  target_compile_options(hyoryu_options INTERFACE -fsanitize=fuzzer-no-link)
  target_link_options(hyoryu_options INTERFACE -fsanitize=fuzzer-no-link)
endif()
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG")

# The instruction sets of the hot loops, by the bytes of a register: those of this machine, or, where
# the program is to run on any x86-64, one after the other, chosen at start.
if(HYORYU_NATIVE OR NOT CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  if(HYORYU_NATIVE)
    set(native_flag -march=native -w)
  endif()
  execute_process(COMMAND ${CMAKE_CXX_COMPILER} ${native_flag} -dM -E -x c++ /dev/null
    OUTPUT_VARIABLE predefined)
  if(predefined MATCHES "__AVX512VL__")
    set(HYORYU_SETS 64)
    set(HYORYU_FLAGS_64 -mprefer-vector-width=512)
  elseif(predefined MATCHES "__AVX2__")
    set(HYORYU_SETS 32)
  else()
    set(HYORYU_SETS 16)
  endif()
else()
  set(HYORYU_SETS 16 32 64)
  set(HYORYU_FLAGS_32 -march=x86-64-v3)
  set(HYORYU_FLAGS_64 -march=x86-64-v4 -mprefer-vector-width=512)
endif()
list(LENGTH HYORYU_WITHOUT HYORYU_WITHOUT_COUNT)
list(TRANSFORM HYORYU_WITHOUT REPLACE "(.+)" "\"\\1\"" OUTPUT_VARIABLE HYORYU_WITHOUT_NAMES)
list(JOIN HYORYU_WITHOUT_NAMES ", " HYORYU_WITHOUT_NAMES)
configure_file(${CMAKE_CURRENT_LIST_DIR}/built_effects.hpp.in
  ${PROJECT_BINARY_DIR}/include/hyoryu/core/built_effects.hpp)

list(JOIN HYORYU_SETS ", " HYORYU_REGISTER_SIZES)
configure_file(${CMAKE_CURRENT_LIST_DIR}/compiled_sets.hpp.in
  ${PROJECT_BINARY_DIR}/include/hyoryu/core/compiled_sets.hpp)
