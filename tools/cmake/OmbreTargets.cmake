# One library per folder of src/, its tests beside its sources.

if(OMBRE_TESTS)
  find_package(GTest REQUIRED)
  include(GoogleTest)
endif()
set(OMBRE_TEST_TIMEOUT 300) # s
if(OMBRE_SANITIZE) # which make all take ten times as long
  set(OMBRE_TEST_TIMEOUT 400)
endif()

# A few sources of it at once, where heavy headers take longer than what includes them; few, so that a change of one
# costs little.
function(ombre_few_at_once target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
  target_compile_options(${target} PRIVATE ${OMBRE_UNITY_OPTIONS})
endfunction()

# Code that runs once for each job, and never for each voxel, is compiled in two thirds of the time when it is optimised less.
function(ombre_optimise_less)
  set(option $<$<CONFIG:Release>:-O1>)
  if(OMBRE_SANITIZE)
    set(option -O0)
  endif()
  foreach(target ${ARGV})
    target_compile_options(${target} PRIVATE ${option})
  endforeach()
endfunction()

function(ombre_test_options target)
  set_property(GLOBAL APPEND PROPERTY OMBRE_TEST_PROGRAMS ${target})
  ombre_few_at_once(${target})
  ombre_optimise_less(${target})
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

# ombre_module(<name> SOURCES files [LINKS third-party libraries])
# A module that is loaded when it is first needed (base/module_loader.h), since loading the libraries takes longer than many
# jobs, and compiling it longer than the program. The program runs without it, says what is missing, and shares no code with
# it; the module has its own of what errors need.
function(ombre_module name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINKS" ${ARGN})
  add_library(ombre_${name} MODULE ${ARG_SOURCES} ${PROJECT_SOURCE_DIR}/src/base/phrase.cpp)
  target_include_directories(ombre_${name} PRIVATE ${PROJECT_SOURCE_DIR}/src)
  target_link_libraries(ombre_${name} PRIVATE ${ARG_LINKS})
  set_target_properties(ombre_${name} PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/modules)
  set_property(GLOBAL APPEND PROPERTY OMBRE_MODULES ombre_${name})
  install(TARGETS ombre_${name} LIBRARY DESTINATION ${OMBRE_MODULE_DIR} COMPONENT shared)
endfunction()

# The target "modules" makes all modules; the test programs load them.
function(ombre_all_modules)
  get_property(modules GLOBAL PROPERTY OMBRE_MODULES)
  get_property(tests GLOBAL PROPERTY OMBRE_TEST_PROGRAMS)
  add_custom_target(modules)
  if(TARGET fuzz_targets)
    list(APPEND tests fuzz_targets)
  endif()
  if(modules)
    foreach(target modules ${tests})
      add_dependencies(${target} ${modules})
    endforeach()
  endif()
endfunction()
