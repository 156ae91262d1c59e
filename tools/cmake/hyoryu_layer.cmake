# hyoryu_layer(NAME LINKS ... PRIVATE_LINKS ...): the static library of src/NAME with the headers of
# include/hyoryu/NAME; every header must compile alone.
function(hyoryu_layer name)
  cmake_parse_arguments(arg "" "" "LINKS;PRIVATE_LINKS" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/${name}/*.cpp)
  file(GLOB headers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/include/hyoryu/${name}/*.hpp)
  add_library(hyoryu_${name} STATIC ${sources})
  add_library(hyoryu::${name} ALIAS hyoryu_${name})
  target_sources(hyoryu_${name} PUBLIC FILE_SET HEADERS
    BASE_DIRS ${PROJECT_SOURCE_DIR}/include FILES ${headers})
  target_include_directories(hyoryu_${name} PRIVATE ${PROJECT_SOURCE_DIR}/src/${name})
  target_link_libraries(hyoryu_${name} PUBLIC ${arg_LINKS} PRIVATE ${arg_PRIVATE_LINKS}
    $<BUILD_INTERFACE:hyoryu_options>)
  set_target_properties(hyoryu_${name} PROPERTIES VERIFY_INTERFACE_HEADER_SETS ON)
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
