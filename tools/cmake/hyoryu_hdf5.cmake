# HDF5 for the program. Debian's shared library brings thirty others, for files in the network, which nothing here
# opens: 6 MB of memory and half of the time to start. Its static library leaves them out. The program takes it
# where it is found and links; modules and tests keep the shared one, as VTK does.
option(HYORYU_STATIC_HDF5 "Link the program with the static library of HDF5, where it is found" ON)
find_package(HDF5 REQUIRED COMPONENTS C)

if(HYORYU_STATIC_HDF5)
  include(CheckCSourceCompiles)
  list(GET HDF5_C_LIBRARIES 0 shared)
  cmake_path(GET shared PARENT_PATH folder)
  find_library(HYORYU_HDF5_ARCHIVE libhdf5.a PATHS ${folder} NO_DEFAULT_PATH)
  find_library(HYORYU_SZ sz)
  find_library(HYORYU_Z z)
  mark_as_advanced(HYORYU_HDF5_ARCHIVE HYORYU_SZ HYORYU_Z)
endif()
if(HYORYU_STATIC_HDF5 AND HYORYU_HDF5_ARCHIVE AND HYORYU_SZ AND HYORYU_Z)
  add_library(hyoryu_hdf5_archive INTERFACE IMPORTED)
  target_include_directories(hyoryu_hdf5_archive INTERFACE ${HDF5_C_INCLUDE_DIRS})
  target_link_libraries(hyoryu_hdf5_archive INTERFACE
    ${HYORYU_HDF5_ARCHIVE} ${HYORYU_SZ} ${HYORYU_Z} ${CMAKE_DL_LIBS} m)
  # Hidden in the program, so that the HDF5 of VTK keeps to its own functions.
  target_link_options(hyoryu_hdf5_archive INTERFACE -Wl,--exclude-libs,libhdf5.a)
  set(CMAKE_REQUIRED_LIBRARIES hyoryu_hdf5_archive)
  check_c_source_compiles("#include <hdf5.h>
    int main(void) { return H5open() + (int)H5Fopen(\"\", H5F_ACC_RDONLY, H5P_DEFAULT); }"
    HYORYU_HDF5_ARCHIVE_LINKS)
  unset(CMAKE_REQUIRED_LIBRARIES)
endif()

# What a target links: by its property STATIC_HDF5.
add_library(hyoryu_hdf5 INTERFACE)
if(HYORYU_STATIC_HDF5 AND HYORYU_HDF5_ARCHIVE_LINKS)
  target_link_libraries(hyoryu_hdf5 INTERFACE
    $<IF:$<BOOL:$<TARGET_PROPERTY:STATIC_HDF5>>,hyoryu_hdf5_archive,hdf5::hdf5>)
else()
  target_link_libraries(hyoryu_hdf5 INTERFACE hdf5::hdf5)
endif()
