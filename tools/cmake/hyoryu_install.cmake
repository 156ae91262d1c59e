# What `cmake --install` and the Debian packages hold: the component `program`, and `vtk`, `gis` and
# `mpi` with the modules that need VTK, GDAL and MPI, which the program finds in ../lib/hyoryu from its own folder.
include(GNUInstallDirs)
install(TARGETS hyoryu RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
install(DIRECTORY ${PROJECT_BINARY_DIR}/texts/man/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1
  COMPONENT program)
install(FILES ${PROJECT_BINARY_DIR}/texts/completions/hyoryu COMPONENT program
  DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
install(FILES ${PROJECT_BINARY_DIR}/texts/completions/_hyoryu COMPONENT program
  DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions)
install(FILES ${PROJECT_BINARY_DIR}/texts/completions/hyoryu.fish COMPONENT program
  DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
install(DIRECTORY cases DESTINATION ${CMAKE_INSTALL_DATADIR}/hyoryu COMPONENT program
  PATTERN "*-results" EXCLUDE)
install(FILES src/scene/case/debris.toml DESTINATION ${CMAKE_INSTALL_DATADIR}/hyoryu
  COMPONENT program)
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
install(FILES README.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright COMPONENT program)
set(CPACK_COMPONENTS_ALL program)
foreach(module vtk gis mpi)
  if(TARGET hyoryu_${module})
    install(TARGETS hyoryu_${module} LIBRARY DESTINATION lib/hyoryu COMPONENT ${module})
    install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/hyoryu-${module} RENAME copyright
      COMPONENT ${module})
    list(APPEND CPACK_COMPONENTS_ALL ${module})
  endif()
endforeach()

# Debian packages, by scripts/package.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME hyoryu)
set(CPACK_PACKAGE_CONTACT "The Hyoryu developers")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME hyoryu)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS hyoryu-vtk)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "Simulates floods that carry debris: a particle fluid (SPH, MPS)
coupled both ways to rigid bodies that meet through impulses.")
set(CPACK_DEBIAN_VTK_PACKAGE_NAME hyoryu-vtk)
# Program and module are of one build. The driver draws where there is no screen.
set(CPACK_DEBIAN_VTK_PACKAGE_DEPENDS "hyoryu (= ${PROJECT_VERSION}), libgl1-mesa-dri")
set(CPACK_DEBIAN_VTK_PACKAGE_RECOMMENDS ffmpeg)
set(CPACK_COMPONENT_VTK_DESCRIPTION "Meshes and pictures for hyoryu: what needs VTK.")
set(CPACK_DEBIAN_GIS_PACKAGE_NAME hyoryu-gis)
set(CPACK_DEBIAN_GIS_PACKAGE_DEPENDS "hyoryu (= ${PROJECT_VERSION})")
set(CPACK_COMPONENT_GIS_DESCRIPTION "GeoTIFF and other rasters for hyoryu: what needs GDAL.")
set(CPACK_DEBIAN_MPI_PACKAGE_NAME hyoryu-mpi)
# The launcher is of the MPI that the module is linked to.
set(CPACK_DEBIAN_MPI_PACKAGE_DEPENDS "hyoryu (= ${PROJECT_VERSION}), openmpi-bin")
set(CPACK_COMPONENT_MPI_DESCRIPTION "Runs of hyoryu that several processes share: what needs MPI.")
include(CPack)
