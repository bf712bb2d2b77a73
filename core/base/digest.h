// SHA-256 of canonical bytes: the identity of volumes, stage results and meshes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include "types/label_volume.h"
#include "types/scalar_volume.h"
#include "types/surface_mesh.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// Incremental SHA-256 (FIPS 180-4).
class Sha256 {
 public:
  Sha256();
  void update(std::span<const std::uint8_t> bytes);
  void update(std::string_view text);
  /// Little-endian bytes of an array of arithmetic values (all supported platforms are little-endian).
  template <class T>
  void update_values(const T* values, std::size_t count) {
    static_assert(std::is_arithmetic_v<T>);
    update({reinterpret_cast<const std::uint8_t*>(values), count * sizeof(T)});
  }
  /// Lower-case hexadecimal digest, 64 characters. Ends the computation.
  std::string hex();

 private:
  void compress(const std::uint8_t* block);
  std::array<std::uint32_t, 8> state_;
  std::array<std::uint8_t, 64> buffer_{};
  std::uint64_t total_ = 0;
};

/// Points (float64), tets (uint32), labels (uint16), in order.
std::string digest_of(const TetMesh& mesh);
/// Points (float64), triangles (uint32), sides (uint16), in order.
std::string digest_of(const SurfaceMesh& surface);
/// Size (int32 x 3), affine rows (float32, so that formats storing it at single precision agree), labels
/// (uint16).
std::string digest_of(const LabelVolume& volume);
/// The same with the values (float32) in place of labels.
std::string digest_of(const ScalarVolume& volume);

}  // namespace voxtet
