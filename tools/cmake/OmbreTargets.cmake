# One library per room of src/: a folder, or a folder in one; its tests beside its sources.

if(OMBRE_TESTS)
  find_package(GTest REQUIRED)
  include(GoogleTest)
endif()
set(OMBRE_TEST_TIMEOUT 1200) # s, after which a test hangs

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
    get_target_property(type ${target} TYPE)
    if(type STREQUAL "INTERFACE_LIBRARY") # all rooms of a folder
      get_target_property(rooms ${target} INTERFACE_LINK_LIBRARIES)
      ombre_optimise_less(${rooms})
    else()
      target_compile_options(${target} PRIVATE ${option})
    endif()
  endforeach()
endfunction()

function(ombre_test_options target)
  set_property(GLOBAL APPEND PROPERTY OMBRE_TEST_PROGRAMS ${target})
  ombre_few_at_once(${target})
  ombre_optimise_less(${target})
  if(OMBRE_SANITIZE) # a third of the time goes into lines and coverage of tests, which nobody reads
    target_compile_options(${target} PRIVATE -g0)
  endif()
  if(OMBRE_FUZZ)
    target_compile_options(${target} PRIVATE -fno-sanitize=fuzzer-no-link)
  endif()
endfunction()

# The target of a room: formats/mesh is ombre_formats_mesh.
function(ombre_targets_of result)
  string(REPLACE "/" "_" names "${ARGN}")
  list(TRANSFORM names PREPEND ombre_)
  set(${result} ${names} PARENT_SCOPE)
endfunction()

# ombre_room(<path in src> [SUBFOLDERS of sources] [DEPENDS rooms or folders] [LINKS third-party libraries])
# Every .cpp here belongs to the library, but for every *_test.cpp, which is a test program's, and every *_module.cpp.
function(ombre_room room)
  cmake_parse_arguments(ARG "" "" "SUBFOLDERS;DEPENDS;LINKS" ${ARGN})
  set(patterns ${PROJECT_SOURCE_DIR}/src/${room}/*.cpp)
  foreach(subfolder ${ARG_SUBFOLDERS})
    list(APPEND patterns ${PROJECT_SOURCE_DIR}/src/${room}/${subfolder}/*.cpp)
  endforeach()
  file(GLOB sources CONFIGURE_DEPENDS ${patterns})
  list(FILTER sources EXCLUDE REGEX "_(test|module)\\.cpp$")
  ombre_targets_of(target ${room})
  ombre_targets_of(dependencies ${ARG_DEPENDS})
  if(sources)
    add_library(${target} STATIC ${sources})
    target_include_directories(${target} PUBLIC ${PROJECT_SOURCE_DIR}/src)
    target_link_libraries(${target} PUBLIC ${dependencies} PRIVATE ${ARG_LINKS})
  else() # headers alone
    add_library(${target} INTERFACE)
    target_link_libraries(${target} INTERFACE ${dependencies})
  endif()
endfunction()

# ombre_test_program(<name> SOURCES tests LINKS libraries): a program of unit tests, each of which ctest knows.
function(ombre_test_program name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINKS" ${ARGN})
  if(NOT TARGET ombre_test_main)
    add_library(ombre_test_main OBJECT ${PROJECT_SOURCE_DIR}/tests/test_main.cpp)
    target_include_directories(ombre_test_main PRIVATE ${PROJECT_SOURCE_DIR}/src)
    target_compile_definitions(ombre_test_main PRIVATE OMBRE_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
    target_link_libraries(ombre_test_main PUBLIC GTest::gtest)
  endif()
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_LINKS} ombre_test_main)
  ombre_test_options(${name})
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT ${OMBRE_TEST_TIMEOUT} PROPERTIES TIMEOUT ${OMBRE_TEST_TIMEOUT})
endfunction()

# ombre_tests(<folder> [FOLDERS that it tests]): a program of all tests in the folder and its rooms.
function(ombre_tests folder)
  cmake_parse_arguments(ARG "" "" "FOLDERS" ${ARGN})
  set(patterns)
  foreach(tested ${ARG_FOLDERS} ${folder})
    list(APPEND patterns ${PROJECT_SOURCE_DIR}/src/${tested}/*_test.cpp)
  endforeach()
  file(GLOB_RECURSE tests CONFIGURE_DEPENDS ${patterns})
  if(NOT OMBRE_TESTS OR NOT tests)
    return()
  endif()
  ombre_test_program(test_${folder} SOURCES ${tests} LINKS ombre_${folder})
endfunction()

# ombre_rooms(<folder> <rooms...> [FOLDERS that it tests besides]): all rooms of a folder as one, and their tests.
function(ombre_rooms folder)
  cmake_parse_arguments(ARG "" "" "FOLDERS" ${ARGN})
  set(rooms ${ARG_UNPARSED_ARGUMENTS})
  list(TRANSFORM rooms PREPEND ombre_${folder}_)
  add_library(ombre_${folder} INTERFACE)
  target_link_libraries(ombre_${folder} INTERFACE ${rooms})
  ombre_tests(${folder} FOLDERS ${ARG_FOLDERS})
endfunction()

# A folder that is one room, with its tests; as ombre_room.
function(ombre_folder name)
  ombre_room(${name} ${ARGN})
  ombre_tests(${name})
endfunction()

# ombre_module(<name> SOURCES files [LINKS third-party libraries])
# A module that is loaded when it is first needed (base/system/module_loader.h), since loading the libraries takes longer than many
# jobs, and compiling it longer than the program. The program runs without it, says what is missing, and shares no code with
# it; the module has its own of what errors need.
function(ombre_module name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINKS" ${ARGN})
  add_library(ombre_${name} MODULE ${ARG_SOURCES} ${PROJECT_SOURCE_DIR}/src/base/text/phrase.cpp)
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
