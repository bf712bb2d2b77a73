#include "io/volume/write_vti.h"

#include <array>
#include <cstdio>
#include <initializer_list>

#include "io/bytes/byte_writer.h"

namespace voxtet {
namespace {

std::string numbers(std::initializer_list<double> values) {
  std::string text;
  for (const double value : values) {
    std::array<char, 32> digits{};
    std::snprintf(digits.data(), digits.size(), "%.17g", value);
    text += (text.empty() ? "" : " ") + std::string(digits.data());
  }
  return text;
}

}  // namespace

Result<Bytes> write_vti(const ScalarVolume& volume, const std::string& name) {
  const Eigen::Vector3d spacing = volume.spacing_mm();
  const Eigen::Matrix3d d = volume.linear() * spacing.cwiseInverse().asDiagonal();
  if (!(d.transpose() * d).isIdentity(1e-4))
    return Error{ErrorCode::kUsage,
                 "write_vti",
                 "the volume's axes are not at right angles, which a .vti cannot hold; expected .nii",
                 {}};
  const auto& m = volume.index_to_mm;
  const std::string extent = "0 " + std::to_string(volume.size[0] - 1) + " 0 " +
                             std::to_string(volume.size[1] - 1) + " 0 " + std::to_string(volume.size[2] - 1);
  const std::string head =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
      "<ImageData WholeExtent=\"" +
      extent + "\" Origin=\"" + numbers({m(0, 3), m(1, 3), m(2, 3)}) + "\" Spacing=\"" +
      numbers({spacing[0], spacing[1], spacing[2]}) + "\" Direction=\"" +
      numbers({d(0, 0), d(0, 1), d(0, 2), d(1, 0), d(1, 1), d(1, 2), d(2, 0), d(2, 1), d(2, 2)}) +
      "\">\n<Piece Extent=\"" + extent + "\">\n<PointData Scalars=\"" + name +
      "\">\n<DataArray type=\"Float32\" Name=\"" + name +
      "\" format=\"appended\" offset=\"0\"/>\n</PointData>\n</Piece>\n</ImageData>\n"
      "<AppendedData encoding=\"raw\">\n_";
  const std::string foot = "\n</AppendedData>\n</VTKFile>\n";
  const std::size_t bytes = volume.values.size() * sizeof(float);
  ByteWriter out(head.size() + sizeof(std::uint64_t) + bytes + foot.size());
  out.text(head);
  out.raw(std::uint64_t{bytes});
  for (const float value : volume.values) out.raw(value);
  out.text(foot);
  return out.take();
}

}  // namespace voxtet
