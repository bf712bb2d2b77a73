#include "io/mesh/read/xdmf/hdf5_file.h"

#include <zlib.h>

#include <Eigen/Core>
#include <cstring>
#include <optional>
#include <string>
#include <utility>

#include "io/bytes/bytes.h"
#include "io/bytes/header_text.h"

namespace voxtet {
namespace {

constexpr std::string_view kSignature = "\x89HDF\r\n\x1a\n";
constexpr std::uint64_t kRootHeader = 64;  // the address of the root group's header, in superblock 0
constexpr std::uint64_t kNoAddress = ~std::uint64_t{0};
constexpr std::uint64_t kOneBlock = 1, kChunks = 2;
constexpr std::uint64_t kDeflate = 1, kFletcher = 3;  // shuffle is between them
constexpr std::uint64_t kMostCompression = 1032;      // deflate's
constexpr std::uint64_t kMostRank = 32;
constexpr int kMostNodes = 100000;  // of one group, so that a circle of addresses ends

/// The messages of an object that say what it is.
struct ObjectHeader {
  std::optional<std::uint64_t> tree, heap;  ///< of a group
  std::vector<std::uint64_t> shape;
  bool has_shape = false;
  int number_class = -1;  ///< 0: whole, 1: real
  bool is_signed = false, big_endian = false;
  std::uint64_t number_bytes = 0;
  std::uint64_t layout = 0;            ///< class: 1 one block, 2 chunks
  std::uint64_t data = 0;              ///< address of the block, or of the tree of chunks
  std::vector<std::uint64_t> chunk;    ///< shape of a chunk
  std::vector<std::uint64_t> filters;  ///< in the order in which they were applied
};

class Hdf5Reader {
 public:
  explicit Hdf5Reader(std::span<const std::uint8_t> file) : file_(file) {}

  Result<Hdf5Values> read(std::string_view path) {
    if (file_.size() < 96 || std::memcmp(file_.data(), kSignature.data(), kSignature.size()) != 0)
      return refuse("no HDF5 file: its first bytes are others");
    if (file_[8] != 0 || file_[13] != 8 || file_[14] != 8)
      return refuse("HDF5 superblock " + std::to_string(file_[8]) + ", expected 0 with addresses of 8 bytes");
    std::uint64_t at = number(kRootHeader, 8);
    std::string_view rest = path;
    while (true) {
      while (rest.starts_with('/')) rest.remove_prefix(1);
      if (rest.empty()) break;
      const std::string_view name = rest.substr(0, rest.find('/'));
      rest.remove_prefix(name.size());
      ObjectHeader group;
      read_header(at, group);
      std::optional<std::uint64_t> found;
      if (group.tree && group.heap) {
        int nodes = 0;
        found = find_in_tree(*group.tree, number(*group.heap + 24, 8), name, nodes);
      }
      if (!found) return refuse("no array " + in_quotes(path) + ": " + in_quotes(name) + " is not there");
      at = *found;
    }
    return read_array(at, path);
  }

 private:
  static Error refuse(const std::string& message) { return {ErrorCode::kBadInput, "read_hdf5", message, {}}; }

  bool holds(std::uint64_t at, std::uint64_t bytes) const {
    return at <= file_.size() && bytes <= file_.size() - at;
  }
  /// Little-endian; 0 where the file is too short.
  std::uint64_t number(std::uint64_t at, std::size_t bytes) const {
    std::uint64_t value = 0;
    if (!holds(at, bytes)) return 0;
    std::memcpy(&value, file_.data() + at, bytes);
    return value;
  }
  bool is_marked(std::uint64_t at, std::string_view mark) const {
    return holds(at, mark.size()) && std::memcmp(file_.data() + at, mark.data(), mark.size()) == 0;
  }

  /// Messages of an object header of version 1, in its first block and in those that continue it.
  void read_header(std::uint64_t at, ObjectHeader& header) const {
    if (number(at, 1) != 1) return;
    std::uint64_t messages = number(at + 2, 2);
    std::vector<std::pair<std::uint64_t, std::uint64_t>> blocks{{at + 16, number(at + 8, 4)}};
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      auto [place, left] = blocks[b];
      while (messages > 0 && left >= 8 && holds(place, 8)) {
        const std::uint64_t type = number(place, 2), size = number(place + 2, 2);
        if (size + 8 > left || !holds(place + 8, size)) break;
        if (type == 0x10)
          blocks.emplace_back(number(place + 8, 8), number(place + 16, 8));
        else
          read_message(type, place + 8, header);
        place += 8 + size;
        left -= 8 + size;
        --messages;
      }
    }
  }

  void read_message(std::uint64_t type, std::uint64_t at, ObjectHeader& header) const {
    if (type == 0x11) {
      header.tree = number(at, 8);
      header.heap = number(at + 8, 8);
    } else if (type == 0x01) {
      const std::uint64_t version = number(at, 1), rank = number(at + 1, 1);
      const std::uint64_t first = at + (version == 1 ? 8 : 4);
      header.has_shape = (version == 1 || version == 2) && rank <= kMostRank;
      for (std::uint64_t d = 0; header.has_shape && d < rank; ++d)
        header.shape.push_back(number(first + 8 * d, 8));
    } else if (type == 0x03) {
      header.number_class = static_cast<int>(number(at, 1) & 0xf);
      const std::uint64_t bits = number(at + 1, 1);
      header.big_endian = (bits & 1) != 0;
      header.is_signed = (bits & 8) != 0;
      header.number_bytes = number(at + 4, 4);
    } else if (type == 0x08) {
      read_layout(at, header);
    } else if (type == 0x0b) {
      read_filters(at, header);
    }
  }

  void read_layout(std::uint64_t at, ObjectHeader& header) const {
    if (number(at, 1) != 3) return;
    header.layout = number(at + 1, 1);
    if (header.layout == kOneBlock) header.data = number(at + 2, 8);
    if (header.layout != kChunks) return;
    const std::uint64_t extents = number(at + 2, 1);  // the last is the size of a number
    header.data = number(at + 3, 8);
    for (std::uint64_t d = 0; d + 1 < extents && d < kMostRank; ++d)
      header.chunk.push_back(number(at + 11 + 4 * d, 4));
  }

  void read_filters(std::uint64_t at, ObjectHeader& header) const {
    const std::uint64_t version = number(at, 1), count = number(at + 1, 1);
    at += version == 1 ? 8 : 2;
    for (std::uint64_t f = 0; f < count && f < 32; ++f) {
      const std::uint64_t id = number(at, 2);
      header.filters.push_back(id);
      const bool named = version == 1 || id >= 256;
      const std::uint64_t name = named ? number(at + 2, 2) : 0;
      at += named ? 4 : 2;
      const std::uint64_t values = number(at + 2, 2);
      at += 4 + name + 4 * (version == 1 ? values + values % 2 : values);
    }
  }

  std::string_view name_at(std::uint64_t at) const {
    if (!holds(at, 1)) return {};
    const char* begin = reinterpret_cast<const char*>(file_.data()) + at;
    return {begin, strnlen(begin, file_.size() - at)};
  }

  /// The header of the object with a name, in the tree of a group whose names are at `heap`.
  std::optional<std::uint64_t> find_in_tree(std::uint64_t at, std::uint64_t heap, std::string_view name,
                                            int& nodes) const {
    if (++nodes > kMostNodes) return std::nullopt;
    if (is_marked(at, "SNOD")) {
      const std::uint64_t count = number(at + 6, 2);
      for (std::uint64_t i = 0; i < count; ++i)
        if (const std::uint64_t entry = at + 8 + 40 * i; name_at(heap + number(entry, 8)) == name)
          return number(entry + 8, 8);
      return std::nullopt;
    }
    if (!is_marked(at, "TREE") || number(at + 5, 1) > 20) return std::nullopt;
    const std::uint64_t children = number(at + 6, 2), level = number(at + 5, 1);
    for (std::uint64_t i = 0; i < children; ++i) {
      const std::uint64_t child = number(at + 24 + 16 * i + 8, 8);
      // A child lies one level below, so that no circle is followed deeper than the levels say.
      if (is_marked(child, "TREE") && number(child + 5, 1) >= level) return std::nullopt;
      if (auto found = find_in_tree(child, heap, name, nodes)) return found;
    }
    return std::nullopt;
  }

  Result<Hdf5Values> read_array(std::uint64_t at, std::string_view path) const {
    ObjectHeader header;
    read_header(at, header);
    const std::string array = "array " + in_quotes(path);
    if (!header.has_shape) return refuse(array + " is no array of numbers");
    const std::uint64_t bytes = header.number_bytes;
    const bool real = header.number_class == 1 && (bytes == 4 || bytes == 8);
    const bool whole = header.number_class == 0 && (bytes == 1 || bytes == 2 || bytes == 4 || bytes == 8);
    if (!(real || whole) || header.big_endian)
      return refuse(array + ": expected little-endian whole or real numbers of at most 8 bytes");
    const std::optional<std::uint64_t> held = count_of(header.shape);
    if (!held) return refuse(array + " has more numbers than the file can hold");
    const std::uint64_t count = *held;
    if (header.layout == kChunks) return read_chunks(header, count, array);
    if (header.layout != kOneBlock || !header.filters.empty())
      return refuse(array + " is stored in a way that is not read, expected one block or chunks");
    if (count > 0 &&
        (header.data == kNoAddress || !holds(header.data, 1) || count > (file_.size() - header.data) / bytes))
      return refuse(array + " has " + std::to_string(count) + " numbers, and the file ends before the last");
    Hdf5Values out{header.shape, {}};
    out.values.reserve(static_cast<std::size_t>(count));
    for (std::uint64_t i = 0; i < count; ++i)
      out.values.push_back(value_of(number(header.data + i * bytes, bytes), header));
    return out;
  }

  /// The product of extents; none where no compression could put as many bytes into the file.
  std::optional<std::uint64_t> count_of(const std::vector<std::uint64_t>& extents) const {
    const std::uint64_t most = file_.size() * kMostCompression;
    std::uint64_t count = 1;
    for (const std::uint64_t extent : extents) {
      if (extent != 0 && count > most / extent) return std::nullopt;
      count *= extent;
    }
    return count;
  }

  Result<Hdf5Values> read_chunks(const ObjectHeader& header, std::uint64_t count,
                                 const std::string& array) const {
    const std::optional<std::uint64_t> in_chunk = count_of(header.chunk);
    if (header.chunk.empty() || header.chunk.size() != header.shape.size() || !in_chunk || *in_chunk == 0)
      return refuse(array + ": its chunks have another shape than itself");
    for (const std::uint64_t filter : header.filters)
      if (filter < kDeflate || filter > kFletcher)
        return refuse(array + " is compressed by the filter " + std::to_string(filter) +
                      ", expected deflate (1), shuffle (2) or Fletcher's checksum (3)");
    ChunkFiller filler{
        header, *in_chunk, {header.shape, std::vector<double>(static_cast<std::size_t>(count))}};
    for (std::size_t d = 0; d < header.shape.size(); ++d)
      filler.chunks_left *= (header.shape[d] + header.chunk[d] - 1) / header.chunk[d];
    if (count > 0 && !read_chunk_tree(header.data, filler)) return refuse(array + " has a damaged chunk");
    if (filler.filled != count)
      return refuse(array + " has " + std::to_string(count) + " numbers, found " +
                    std::to_string(filler.filled));
    return std::move(filler.out);
  }

  /// An array while its chunks are put into it.
  struct ChunkFiller {
    const ObjectHeader& header;
    std::uint64_t in_chunk;
    Hdf5Values out;
    std::uint64_t filled = 0;       ///< numbers that are there
    std::uint64_t chunks_left = 1;  ///< more are a fault
    int nodes = 0;

    /// `bytes` is a whole chunk. Chunks at the end of an array stand out over it.
    void put(const Bytes& bytes, const std::vector<std::uint64_t>& corner) {
      const std::size_t rank = header.chunk.size();
      std::vector<std::uint64_t> index(rank, 0);
      for (std::uint64_t i = 0; i < in_chunk; ++i) {
        std::uint64_t place = 0;
        bool inside = true;
        for (std::size_t d = 0; d < rank; ++d) {
          const std::uint64_t at = corner[d] + index[d];
          inside = inside && at >= corner[d] && at < header.shape[d];
          place = place * header.shape[d] + at;
        }
        if (inside) {
          std::uint64_t bits = 0;
          std::memcpy(&bits, bytes.data() + i * header.number_bytes, header.number_bytes);
          out.values[static_cast<std::size_t>(place)] = value_of(bits, header);
          ++filled;
        }
        for (std::size_t d = rank; d-- > 0 && ++index[d] == header.chunk[d];) index[d] = 0;
      }
    }
  };

  bool read_chunk_tree(std::uint64_t at, ChunkFiller& filler) const {
    if (++filler.nodes > kMostNodes || !is_marked(at, "TREE") || number(at + 4, 1) != 1) return false;
    const std::size_t rank = filler.header.chunk.size();
    const std::uint64_t level = number(at + 5, 1), children = number(at + 6, 2), key = 8 + 8 * (rank + 1);
    for (std::uint64_t i = 0; i < children; ++i) {
      const std::uint64_t place = at + 24 + i * (key + 8), child = number(place + key, 8);
      if (level > 0) {
        if (is_marked(child, "TREE") && number(child + 5, 1) >= level) return false;
        if (!read_chunk_tree(child, filler)) return false;
        continue;
      }
      const std::uint64_t bytes = number(place, 4);
      if (filler.chunks_left-- == 0 || !holds(child, bytes)) return false;
      std::vector<std::uint64_t> corner;
      for (std::size_t d = 0; d < rank; ++d) corner.push_back(number(place + 8 + 8 * d, 8));
      const std::span<const std::uint8_t> stored = file_.subspan(child, bytes);
      const auto values = unfiltered(stored, number(place + 4, 4), filler.header, filler.in_chunk);
      if (!values) return false;
      filler.put(*values, corner);
    }
    return true;
  }

  /// The bytes of a chunk before its filters; bits of `skipped` say which of them were not applied.
  static std::optional<Bytes> unfiltered(std::span<const std::uint8_t> stored, std::uint64_t skipped,
                                         const ObjectHeader& header, std::uint64_t in_chunk) {
    const std::uint64_t size = in_chunk * header.number_bytes;
    Bytes bytes(stored.begin(), stored.end());
    for (std::size_t f = header.filters.size(); f-- > 0;) {
      if ((skipped >> f & 1) != 0) continue;
      if (header.filters[f] == kFletcher) {
        if (bytes.size() < 4) return std::nullopt;
        bytes.resize(bytes.size() - 4);
      } else if (header.filters[f] == kDeflate) {
        Bytes inflated(static_cast<std::size_t>(size + 4));  // there may be a checksum in it
        auto length = static_cast<uLongf>(inflated.size());
        if (uncompress(inflated.data(), &length, bytes.data(), static_cast<uLong>(bytes.size())) != Z_OK)
          return std::nullopt;
        inflated.resize(length);
        bytes = std::move(inflated);
      } else {
        bytes = unshuffled(bytes, header.number_bytes);
      }
    }
    if (bytes.size() != size) return std::nullopt;
    return bytes;
  }

  /// Shuffled, the first bytes of all numbers come first, then the second ones.
  static Bytes unshuffled(const Bytes& bytes, std::size_t number_bytes) {
    const std::size_t numbers = bytes.size() / number_bytes;
    Bytes ordered(bytes);
    for (std::size_t i = 0; i < numbers; ++i)
      for (std::size_t b = 0; b < number_bytes; ++b) ordered[i * number_bytes + b] = bytes[b * numbers + i];
    return ordered;
  }

  static double value_of(std::uint64_t bits, const ObjectHeader& header) {
    if (header.number_class == 1)
      return header.number_bytes == 4 ? Eigen::numext::bit_cast<float>(static_cast<std::uint32_t>(bits))
                                      : Eigen::numext::bit_cast<double>(bits);
    if (!header.is_signed) return static_cast<double>(bits);
    const auto shift = static_cast<int>(64 - 8 * header.number_bytes);
    return static_cast<double>(static_cast<std::int64_t>(bits << shift) >> shift);
  }

  std::span<const std::uint8_t> file_;
};

}  // namespace

Result<Hdf5Values> read_hdf5(std::span<const std::uint8_t> file, std::string_view path) {
  return Hdf5Reader(file).read(path);
}

}  // namespace voxtet
