# What nearly every file reads, parsed once and not once a file, which halves the time of a build.
# -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON builds without, and so finds an include that a file forgot.
set(HYORYU_COMMON_HEADERS <Eigen/Dense> <algorithm> <array> <cmath> <filesystem> <fstream> <functional>
  <limits> <map> <memory> <numbers> <numeric> <optional> <span> <sstream> <string> <variant> <vector>
  <fmt/format.h>)

# hyoryu_sources(OUT LAYER): the sources of src/LAYER and of its parts, which are folders within it; those of
# `loops` are compiled otherwise (below).
function(hyoryu_sources out layer)
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/${layer}/*.cpp
    ${PROJECT_SOURCE_DIR}/src/${layer}/*/*.cpp)
  list(FILTER sources EXCLUDE REGEX "/loops/")
  set(${out} ${sources} PARENT_SCOPE)
endfunction()

# hyoryu_layer(NAME LINKS ... PRIVATE_LINKS ...): the static library of src/NAME with the headers of
# include/hyoryu/NAME; every header must compile alone.
function(hyoryu_layer name)
  cmake_parse_arguments(arg "" "" "LINKS;PRIVATE_LINKS" ${ARGN})
  hyoryu_sources(sources ${name})
  file(GLOB headers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/include/hyoryu/${name}/*.hpp)
  add_library(hyoryu_${name} STATIC ${sources})
  add_library(hyoryu::${name} ALIAS hyoryu_${name})
  target_sources(hyoryu_${name} PUBLIC FILE_SET HEADERS
    BASE_DIRS ${PROJECT_SOURCE_DIR}/include FILES ${headers})
  target_include_directories(hyoryu_${name} PRIVATE ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR}/src/${name})
  target_link_libraries(hyoryu_${name} PUBLIC ${arg_LINKS} PRIVATE ${arg_PRIVATE_LINKS}
    $<BUILD_INTERFACE:hyoryu_options>)
  set_target_properties(hyoryu_${name} PROPERTIES VERIFY_INTERFACE_HEADER_SETS ON)
  if(name STREQUAL "core")
    target_precompile_headers(hyoryu_core PRIVATE ${HYORYU_COMMON_HEADERS})
  elseif(NOT name STREQUAL "view") # its files are VTK's, with definitions of their own
    target_precompile_headers(hyoryu_${name} REUSE_FROM hyoryu_core)
  endif()
endfunction()

# hyoryu_hot_loops(LAYER): compiles src/LAYER/loops/*.cpp once for each instruction set and adds the
# objects to the layer. Each file finds the bytes of a register in HYORYU_REGISTER_BYTES.
function(hyoryu_hot_loops name)
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/${name}/loops/*.cpp)
  # Contraction is welcome here, where it is safe: a pair is seen from both sides by the same code,
  # whose operations all either keep their value or change their sign when i and j change places.
  set_source_files_properties(${sources} PROPERTIES COMPILE_OPTIONS -ffp-contract=fast)
  foreach(bytes IN LISTS HYORYU_SETS)
    set(loops hyoryu_${name}_${bytes})
    add_library(${loops} OBJECT ${sources})
    target_compile_options(${loops} PRIVATE ${HYORYU_FLAGS_${bytes}})
    target_compile_definitions(${loops} PRIVATE HYORYU_REGISTER_BYTES=${bytes})
    target_link_libraries(${loops} PRIVATE hyoryu_options
      $<TARGET_PROPERTY:hyoryu_${name},LINK_LIBRARIES>)
    target_include_directories(${loops} PRIVATE
      $<TARGET_PROPERTY:hyoryu_${name},INCLUDE_DIRECTORIES>)
    target_sources(hyoryu_${name} PRIVATE $<TARGET_OBJECTS:${loops}>)
  endforeach()
endfunction()

# hyoryu_use_vtk(LAYER LIBRARIES...): links VTK to a leaf layer; without VTK its files compile to
# functions that say so.
function(hyoryu_use_vtk name)
  if(HYORYU_VTK)
    target_compile_definitions(hyoryu_${name} PRIVATE HYORYU_HAS_VTK)
    target_link_libraries(hyoryu_${name} PRIVATE ${ARGN})
    vtk_module_autoinit(TARGETS hyoryu_${name} MODULES ${VTK_LIBRARIES})
  endif()
endfunction()
