// Tests of VTK's files of HDF5 that are no grids; tests/run_results.py reads grids that h5py writes.
#include <gtest/gtest.h>

#include "formats/containers/hdf5.h"
#include "formats/results/results.h"

#ifdef OMBRE_HDF5

namespace ombre::formats {

TEST(VtkHdf, FilesWithoutAGridAreReported) {
  const std::vector<double> numbers{1, 2, 3};
  const std::string file = hdf5_file({{"/VTKHDF/Points", Hdf5Array::Kind::float64, {1, 3}, numbers.data()}});
  const auto said = [](const std::string& bytes) {
    Diagnostics diagnostics;
    EXPECT_FALSE(read_results("a.vtkhdf", bytes, {}, diagnostics));
    return to_text(diagnostics);
  };
  EXPECT_NE(said(file).find("no group VTKHDF with a type"), std::string::npos) << said(file);
  EXPECT_NE(said(file.substr(0, 200)).find("no file of HDF5, or it is damaged"), std::string::npos);
}

}  // namespace ombre::formats

#endif
