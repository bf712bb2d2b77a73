# voxtet_source_digest: the start of the SHA-256 of everything that decides the bytes of a mesh, equal in every build of one tree. These
# are the sources below and the releases of CGAL and Eigen. Not among them are `io`, whose volumes are named by digests
# of their own; `anatomy`, `transfer`, `quality` and `physics`, which work on a mesh that is made; and `cli`. A file that
# changes makes CMake configure again, so that the digest cannot be old.
# voxtet_physics_digest: likewise of what is simulated on a mesh, `anatomy` and `physics`.
file(GLOB_RECURSE voxtet_sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/core/*.h ${CMAKE_SOURCE_DIR}/core/*.cpp
  ${CMAKE_SOURCE_DIR}/core/*.patch)
set(voxtet_deciding ${voxtet_sources})
list(FILTER voxtet_deciding EXCLUDE REGEX "^${CMAKE_SOURCE_DIR}/core/(io|anatomy|transfer|quality|physics|cli)/")
list(APPEND voxtet_deciding ${CMAKE_SOURCE_DIR}/cmake/flags.cmake)
set(voxtet_simulating ${voxtet_sources})
list(FILTER voxtet_simulating INCLUDE REGEX "^${CMAKE_SOURCE_DIR}/core/(anatomy|physics)/")

# A line for each file: its name and its digest.
function(voxtet_lines_of out)
  list(SORT ARGN)
  set(lines "")
  foreach(file ${ARGN})
    file(SHA256 ${file} digest)
    file(RELATIVE_PATH name ${CMAKE_SOURCE_DIR} ${file})
    string(APPEND lines "${name} ${digest}\n")
  endforeach()
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${ARGN})
  set(${out} "${lines}" PARENT_SCOPE)
endfunction()

voxtet_lines_of(voxtet_digests ${voxtet_deciding})
foreach(release CGAL/version.h Eigen/src/Core/util/Macros.h)
  file(STRINGS ${voxtet_headers}/${release} lines REGEX "define (CGAL_VERSION_NR|EIGEN_[A-Z]+_VERSION) ")
  string(APPEND voxtet_digests "${lines}\n")
endforeach()
string(SHA256 voxtet_source_digest "${voxtet_digests}")
voxtet_lines_of(voxtet_digests ${voxtet_simulating})
string(SHA256 voxtet_physics_digest "${voxtet_digests}")
string(SUBSTRING "${voxtet_source_digest}" 0 12 voxtet_source_digest)
string(SUBSTRING "${voxtet_physics_digest}" 0 12 voxtet_physics_digest)
