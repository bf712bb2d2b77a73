# voxtet_source_digest: SHA-256 of everything that decides the bytes of a mesh, equal in every build of one tree. These
# are the sources below and the releases of CGAL and Eigen. Not among them are `io`, whose volumes are named by digests
# of their own; `anatomy`, `transfer`, `quality` and `physics`, which work on a mesh that is made; and `cli`. A file that
# changes makes CMake configure again, so that the digest cannot be old.
file(GLOB_RECURSE voxtet_deciding CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/core/*.h ${CMAKE_SOURCE_DIR}/core/*.cpp
  ${CMAKE_SOURCE_DIR}/core/*.patch)
list(FILTER voxtet_deciding EXCLUDE REGEX "^${CMAKE_SOURCE_DIR}/core/(io|anatomy|transfer|quality|physics|cli)/")
list(APPEND voxtet_deciding ${CMAKE_SOURCE_DIR}/cmake/flags.cmake)
list(SORT voxtet_deciding)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${voxtet_deciding})
set(voxtet_digests "")
foreach(file ${voxtet_deciding})
  file(SHA256 ${file} digest)
  file(RELATIVE_PATH name ${CMAKE_SOURCE_DIR} ${file})
  string(APPEND voxtet_digests "${name} ${digest}\n")
endforeach()
foreach(release CGAL/version.h Eigen/src/Core/util/Macros.h)
  file(STRINGS ${voxtet_headers}/${release} lines REGEX "define (CGAL_VERSION_NR|EIGEN_[A-Z]+_VERSION) ")
  string(APPEND voxtet_digests "${lines}\n")
endforeach()
string(SHA256 voxtet_source_digest "${voxtet_digests}")
