# toile_count_lines(TARGET): with TOILE_COVERAGE its sources count how often each line ran (tests/coverage).
function(toile_count_lines target)
  if(TOILE_COVERAGE)
    target_compile_options(${target} PRIVATE --coverage -O0)
    target_link_options(${target} PUBLIC --coverage)
  endif()
endfunction()

# toile_room(NAME [PUBLIC target...] [PRIVATE target...])
# A folder of sources as one library `toile_NAME`. PUBLIC links are the rooms it may include; the architecture test
# checks the includes themselves.
function(toile_room name)
  cmake_parse_arguments(ROOM "" "" "PUBLIC;PRIVATE" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  if(sources)
    add_library(toile_${name} STATIC ${sources})
    target_link_libraries(toile_${name} PUBLIC toile_settings ${ROOM_PUBLIC} PRIVATE ${ROOM_PRIVATE})
  else()
    add_library(toile_${name} INTERFACE)
    target_link_libraries(toile_${name} INTERFACE toile_settings ${ROOM_PUBLIC})
  endif()
endfunction()

# toile_test(NAME target...)
# Every *_test.cpp of the calling folder as one GoogleTest program `test_NAME`, each test known to ctest. Suites
# named Slow... carry the label `slow`, all others that of their room.
function(toile_test name)
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*_test.cpp)
  if(NOT sources)
    return()
  endif()
  add_executable(test_${name} ${sources})
  target_link_libraries(test_${name} PRIVATE ${ARGN} toile_test_support toile_ledger GTest::gtest GTest::gmock GTest::gtest_main)
  target_compile_definitions(test_${name} PRIVATE TOILE_SOURCE_DIR="${CMAKE_SOURCE_DIR}"
    TOILE_BINARY_DIR="${CMAKE_BINARY_DIR}")
  gtest_discover_tests(test_${name} TEST_FILTER "-Slow*" DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 300 LABELS ${name})
  gtest_discover_tests(test_${name} TEST_FILTER "Slow*" DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 900 LABELS slow)
endfunction()
