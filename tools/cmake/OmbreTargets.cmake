# One library per folder of src/, its tests beside its sources.

if(OMBRE_TESTS)
  find_package(GTest REQUIRED)
  include(GoogleTest)
endif()
set(OMBRE_TEST_TIMEOUT 300) # s
if(OMBRE_SANITIZE) # which make all take ten times as long
  set(OMBRE_TEST_TIMEOUT 900)
endif()

# A few sources of it at once, where heavy headers take longer than what includes them; few, so that a change of one
# costs little.
function(ombre_few_at_once target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 4)
  target_compile_options(${target} PRIVATE ${OMBRE_UNITY_OPTIONS})
endfunction()

# Tests are compiled in two thirds of the time when they are optimised less than what they test.
function(ombre_test_options target)
  ombre_few_at_once(${target})
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

# ombre_folder(<name> [DEPENDS ombre libraries] [LINKS third-party libraries])
# Every .cpp here belongs to the library, but for every *_test.cpp, which is its test program's, and every *_module.cpp.
function(ombre_folder name)
  cmake_parse_arguments(ARG "" "" "DEPENDS;LINKS" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS *.cpp)
  set(tests ${sources})
  list(FILTER sources EXCLUDE REGEX "_(test|module)\\.cpp$")
  list(FILTER tests INCLUDE REGEX "_test\\.cpp$")

  if(NOT sources) # headers alone
    add_library(ombre_${name} INTERFACE)
    foreach(dependency ${ARG_DEPENDS})
      target_link_libraries(ombre_${name} INTERFACE ombre_${dependency})
    endforeach()
    return()
  endif()
  add_library(ombre_${name} STATIC ${sources})
  target_include_directories(ombre_${name} PUBLIC ${PROJECT_SOURCE_DIR}/src)
  foreach(dependency ${ARG_DEPENDS})
    target_link_libraries(ombre_${name} PUBLIC ombre_${dependency})
  endforeach()
  target_link_libraries(ombre_${name} PRIVATE ${ARG_LINKS})

  if(OMBRE_TESTS AND tests)
    add_executable(test_${name} ${tests})
    target_link_libraries(test_${name} PRIVATE ombre_${name} GTest::gtest_main)
    ombre_test_options(test_${name})
    target_compile_definitions(test_${name} PRIVATE OMBRE_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
    gtest_discover_tests(test_${name} DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT ${OMBRE_TEST_TIMEOUT})
  endif()
endfunction()

# ombre_module(<name> FOR <folder> SOURCES files [LINKS third-party libraries])
# What src/<folder> loads from OMBRE_<NAME>_MODULE when it is first needed (base/module_loader.h), since loading the
# libraries takes longer than many jobs. It shares no code with the program, and has its own of what errors need.
function(ombre_module name)
  cmake_parse_arguments(ARG "" "FOR" "SOURCES;LINKS" ${ARGN})
  add_library(ombre_${name} MODULE ${ARG_SOURCES} ${PROJECT_SOURCE_DIR}/src/base/phrase.cpp)
  target_include_directories(ombre_${name} PRIVATE ${PROJECT_SOURCE_DIR}/src)
  target_link_libraries(ombre_${name} PRIVATE ${ARG_LINKS})
  string(TOUPPER ${name} variable)
  target_compile_definitions(ombre_${ARG_FOR} PRIVATE OMBRE_${variable}_MODULE="$<TARGET_FILE:ombre_${name}>")
  add_dependencies(ombre_${ARG_FOR} ombre_${name})
  install(TARGETS ombre_${name} LIBRARY DESTINATION ${OMBRE_MODULE_DIR} COMPONENT shared)
endfunction()
