# Language, warnings, sanitizers and processor level, as the interface target toile_settings that every room links.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()
# With CMAKE_UNITY_BUILD so many sources of a folder are compiled as one: reading headers is most of what each costs alone.
# So what is private to a file has a name of its own in its folder.
set(CMAKE_UNITY_BUILD_BATCH_SIZE 8)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
endif()

add_library(toile_settings INTERFACE)
target_include_directories(toile_settings INTERFACE ${CMAKE_SOURCE_DIR})
# Cheap checks stay on in release: assert() is kept, Eigen's own bounds checks are not.
string(REPLACE "-DNDEBUG" "" CMAKE_CXX_FLAGS_RELEASE "${CMAKE_CXX_FLAGS_RELEASE}")
string(REPLACE "-DNDEBUG" "" CMAKE_CXX_FLAGS_RELWITHDEBINFO "${CMAKE_CXX_FLAGS_RELWITHDEBINFO}")
target_compile_definitions(toile_settings INTERFACE
  EIGEN_DONT_PARALLELIZE $<$<CONFIG:Release>:EIGEN_NO_DEBUG> TOILE_VERSION="${PROJECT_VERSION}")

add_library(toile_warnings INTERFACE)
target_compile_options(toile_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor
  -Woverloaded-virtual -Wcast-align -Wunused $<$<BOOL:${TOILE_WERROR}>:-Werror>)
target_link_libraries(toile_settings INTERFACE toile_warnings)

if(NOT TOILE_PORTABLE AND NOT DEFINED TOILE_HAS_AVX2 AND CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64")
  include(CheckCXXSourceRuns)
  check_cxx_source_runs("int main() { return __builtin_cpu_supports(\"avx2\") && __builtin_cpu_supports(\"fma\") ? 0 : 1; }"
    TOILE_HAS_AVX2)
endif()
if(TOILE_HAS_AVX2 AND NOT TOILE_PORTABLE)
  target_compile_options(toile_settings INTERFACE -march=x86-64-v3)
endif()

if(TOILE_SANITIZE)
  target_compile_options(toile_settings INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=undefined
    -fno-omit-frame-pointer)
  target_link_options(toile_settings INTERFACE -fsanitize=address,undefined)
endif()
if(TOILE_FUZZ)
  target_compile_options(toile_settings INTERFACE -fsanitize=fuzzer-no-link)
endif()
