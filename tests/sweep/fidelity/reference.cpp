#include "sweep/fidelity/reference.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <span>

#include "base/digest.h"
#include "io/bytes/files.h"

namespace voxtet::sweep {
namespace {

std::string path_of(const std::string& folder, std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c) && c != '.'; }, '_');
  return folder + "/" + name + ".reference";
}

/// For each surface its numbers of points and triangles; then points, triangles and sides, as in memory.
using Counts = std::array<std::uint64_t, 2>;

template <class T>
void append(const T* values, std::size_t count, Bytes& out) {
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(values);
  out.insert(out.end(), bytes, bytes + count * sizeof(T));
}

void append(const SurfaceMesh& surface, Bytes& out) {
  const Counts counts{surface.points.size(), surface.triangles.size()};
  append(&counts, 1, out);
  append(surface.points.data(), counts[0], out);
  append(surface.triangles.data(), counts[1], out);
  append(surface.sides.data(), counts[1], out);
}

Bytes to_bytes(const Reference& reference) {
  Bytes out;
  append(reference.voxels, out);
  append(reference.smoothed, out);
  return out;
}

/// False where fewer bytes are left.
template <class T>
bool take(std::span<const std::uint8_t>& from, std::size_t count, std::vector<T>& out) {
  if (count > from.size() / sizeof(T)) return false;
  out.resize(count);
  std::memcpy(static_cast<void*>(out.data()), from.data(), count * sizeof(T));
  from = from.subspan(count * sizeof(T));
  return true;
}

bool take(std::span<const std::uint8_t>& from, SurfaceMesh& out) {
  std::vector<std::uint64_t> counts;
  return take(from, 2, counts) && take(from, counts[0], out.points) && take(from, counts[1], out.triangles) &&
         take(from, counts[1], out.sides);
}

/// Nothing where the bytes are no reference.
std::optional<Reference> from_bytes(const Bytes& bytes) {
  Reference out;
  std::span<const std::uint8_t> from = bytes;
  if (!take(from, out.voxels) || !take(from, out.smoothed) || !from.empty()) return std::nullopt;
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
  Reference own{*session.surface(), *session.smooth()};
  const Bytes bytes = to_bytes(own);
  own.digest = digest_of_bytes(bytes);
  if (folders.to)
    if (const Status kept = place_files({{path_of(*folders.to, name), bytes}}); !kept) return kept.error();
  return own;
}

}  // namespace voxtet::sweep
