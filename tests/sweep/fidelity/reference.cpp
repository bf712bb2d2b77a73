#include "sweep/fidelity/reference.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>

#include "base/digest.h"
#include "io/bytes/files.h"

namespace voxtet::sweep {
namespace {

std::string path_of(const std::string& folder, std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c) && c != '.'; }, '_');
  return folder + "/" + name + ".reference";
}

/// Numbers of points and triangles; then points, points when smoothed, triangles and sides, as in memory.
using Counts = std::array<std::uint64_t, 2>;
constexpr std::size_t kBytesOfPoint = 2 * sizeof(Eigen::Vector3d),
                      kBytesOfTriangle = sizeof(Triangle) + sizeof(Sides);

template <class T>
void append(const T* values, std::size_t count, Bytes& out) {
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(values);
  out.insert(out.end(), bytes, bytes + count * sizeof(T));
}

Bytes to_bytes(const Reference& reference) {
  const SurfaceMesh& voxels = reference.voxels;
  const Counts counts{voxels.points.size(), voxels.triangles.size()};
  Bytes out;
  out.reserve(sizeof counts + counts[0] * kBytesOfPoint + counts[1] * kBytesOfTriangle);
  append(&counts, 1, out);
  append(voxels.points.data(), counts[0], out);
  append(reference.smoothed.data(), counts[0], out);
  append(voxels.triangles.data(), counts[1], out);
  append(voxels.sides.data(), counts[1], out);
  return out;
}

template <class T>
void take(const std::uint8_t*& from, std::size_t count, std::vector<T>& out) {
  out.resize(count);
  std::memcpy(static_cast<void*>(out.data()), from, count * sizeof(T));
  from += count * sizeof(T);
}

/// Nothing where the bytes are no reference.
std::optional<Reference> from_bytes(const Bytes& bytes) {
  Counts counts{};
  if (bytes.size() < sizeof counts) return std::nullopt;
  std::memcpy(&counts, bytes.data(), sizeof counts);
  if (bytes.size() != sizeof counts + counts[0] * kBytesOfPoint + counts[1] * kBytesOfTriangle)
    return std::nullopt;
  Reference out;
  const std::uint8_t* from = bytes.data() + sizeof counts;
  take(from, counts[0], out.voxels.points);
  take(from, counts[0], out.smoothed);
  take(from, counts[1], out.voxels.triangles);
  take(from, counts[1], out.voxels.sides);
  return out;
}

std::string digest_of_bytes(const Bytes& bytes) {
  Sha256 digest;
  digest.update(bytes);
  return digest.hex();
}

}  // namespace

Result<Reference> reference_of(const std::string& name, const Session& session,
                               const ReferenceFolders& folders) {
  if (folders.from) {
    const std::string path = path_of(*folders.from, name);
    const Result<Bytes> bytes = read_file(path);
    if (!bytes) return bytes.error();
    std::optional<Reference> kept = from_bytes(*bytes);
    if (!kept)
      return Error{ErrorCode::kBadInput,
                   "sweep",
                   path + ": found " + std::to_string(bytes->size()) +
                       " bytes that are no reference, expected what --keep-references writes",
                   {}};
    kept->digest = digest_of_bytes(*bytes);
    return *std::move(kept);
  }
  Reference own{*session.surface(), session.smooth()->points};
  const Bytes bytes = to_bytes(own);
  own.digest = digest_of_bytes(bytes);
  if (folders.to)
    if (const Status kept = place_files({{path_of(*folders.to, name), bytes}}); !kept) return kept.error();
  return own;
}

}  // namespace voxtet::sweep
