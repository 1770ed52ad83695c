# Every dependency of Rehearse is a package of Debian 12; nothing is downloaded or vendored.
# The installed package includes this file too, so that a consumer finds the same ones.
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(hwy 1.0 REQUIRED)
find_package(TBB REQUIRED)
find_package(NLopt REQUIRED)
find_package(Boost 1.74 REQUIRED)
find_package(CLI11 REQUIRED)
find_package(tomlplusplus REQUIRED)
find_package(nlohmann_json 3.11 REQUIRED)
find_package(fmt 9 REQUIRED)
find_package(Threads REQUIRED)

# Optional: several processes under mpirun.
set(MPI_CXX_SKIP_MPICXX TRUE)
find_package(MPI QUIET COMPONENTS CXX)

# The pthread flavour's static library, because the serial one is not thread-safe and the shared
# ones are exchanged behind our back by Debian's alternatives.
find_library(REHEARSE_OPENBLAS_LIBRARY NAMES libopenblas.a PATH_SUFFIXES openblas-pthread REQUIRED)
find_path(REHEARSE_RANDOM123_INCLUDE_DIR NAMES Random123/philox.h REQUIRED)

if(NOT TARGET rehearse::openblas)
  add_library(rehearse::openblas STATIC IMPORTED)
  set_target_properties(rehearse::openblas PROPERTIES
    IMPORTED_LOCATION ${REHEARSE_OPENBLAS_LIBRARY}
    INTERFACE_LINK_LIBRARIES "Threads::Threads;gfortran;m")
endif()
