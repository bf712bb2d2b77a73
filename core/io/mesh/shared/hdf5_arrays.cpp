#include "io/mesh/shared/hdf5_arrays.h"

#include <algorithm>
#include <functional>
#include <initializer_list>
#include <numeric>

namespace voxtet {
namespace {

constexpr std::uint64_t kUndefined = ~std::uint64_t{0};
constexpr std::uint64_t kSuperblockBytes = 96;
constexpr std::uint64_t kRootBytes = 40;
constexpr std::uint16_t kTreeRank = 16;  ///< a B-tree node has room for 2 * rank children
constexpr std::uint64_t kTreeBytes = 24 + 8 * (2 * kTreeRank) + 8 * (2 * kTreeRank + 1);
constexpr std::uint64_t kHeapBytes = 32;
constexpr std::uint64_t kEntryBytes = 40;

enum Message : std::uint16_t {
  kDataspace = 1,
  kDatatype = 3,
  kFillValue = 5,
  kLayout = 8,
  kSymbolTable = 17
};

std::uint64_t up_to_8(std::uint64_t bytes) {
  return (bytes + 7) / 8 * 8;
}

std::uint64_t bytes_of(Hdf5Type type) {
  return type == Hdf5Type::kFloat64 ? 8 : 4;
}

std::uint64_t bytes_of(const Hdf5Array& array) {
  return std::accumulate(array.shape.begin(), array.shape.end(), bytes_of(array.type), std::multiplies<>());
}

std::uint64_t header_bytes(const Hdf5Array& array) {
  return 112 + 8 * array.shape.size();
}

/// Where everything stands. Each entry of a vector belongs to an array.
struct Places {
  std::vector<std::size_t> by_name;  ///< the arrays in the order of the symbol table
  std::vector<std::uint64_t> name, header, values;
  std::uint64_t names_bytes = 8;  ///< the first 8 are the empty name
  std::uint64_t table_rank = 4;   ///< the symbol table has room for 2 * rank entries
  std::uint64_t root = kSuperblockBytes;
  std::uint64_t tree = root + kRootBytes;
  std::uint64_t heap = tree + kTreeBytes;
  std::uint64_t names = heap + kHeapBytes;
  std::uint64_t table = 0, end = 0;
};

Places place(const std::vector<Hdf5Array>& arrays) {
  Places at;
  at.by_name.resize(arrays.size());
  std::iota(at.by_name.begin(), at.by_name.end(), std::size_t{0});
  std::sort(at.by_name.begin(), at.by_name.end(),
            [&](std::size_t a, std::size_t b) { return arrays[a].name < arrays[b].name; });
  for (const Hdf5Array& array : arrays) {
    at.name.push_back(at.names_bytes);
    at.names_bytes += up_to_8(array.name.size() + 1);
  }
  at.table_rank = std::max<std::uint64_t>(4, (arrays.size() + 1) / 2);
  at.table = at.names + at.names_bytes;
  at.end = at.table + 8 + 2 * at.table_rank * kEntryBytes;
  for (const Hdf5Array& array : arrays) {
    at.header.push_back(at.end);
    at.end += header_bytes(array);
  }
  for (const Hdf5Array& array : arrays) {
    at.values.push_back(at.end);
    at.end += bytes_of(array);
  }
  return at;
}

void zeros(ByteWriter& out, std::uint64_t count) {
  for (std::uint64_t i = 0; i < count; ++i) out.raw(std::uint8_t{0});
}

template <class T>
void row(ByteWriter& out, std::initializer_list<T> values) {
  for (const T value : values) out.raw(value);
}

void write_entry(ByteWriter& out, std::uint64_t name, std::uint64_t header) {
  row(out, {name, header});
  zeros(out, kEntryBytes - 16);
}

void write_superblock(ByteWriter& out, const Places& at) {
  out.text("\x89HDF\r\n\x1a\n");
  row<std::uint8_t>(out, {0, 0, 0, 0, 0, 8, 8, 0});  // versions; bytes of an address and of a length
  row<std::uint16_t>(out, {static_cast<std::uint16_t>(at.table_rank), kTreeRank, 0, 0});
  row<std::uint64_t>(out, {0, kUndefined, at.end, kUndefined});
  write_entry(out, 0, at.root);
}

void begin_header(ByteWriter& out, std::uint16_t messages, std::uint64_t bytes) {
  row<std::uint16_t>(out, {1, messages});
  row<std::uint32_t>(out, {1, static_cast<std::uint32_t>(bytes - 16), 0});  // references; bytes that follow
}

void begin_message(ByteWriter& out, Message type, std::uint16_t bytes) {
  row<std::uint16_t>(out, {type, bytes, 0, 0});
}

/// The root group: its B-tree of one leaf, its names, and the leaf.
void write_group(ByteWriter& out, const Places& at, const std::vector<Hdf5Array>& arrays) {
  begin_header(out, 1, kRootBytes);
  begin_message(out, kSymbolTable, 16);
  row(out, {at.tree, at.heap});

  out.text("TREE");
  row<std::uint16_t>(out, {0, 1});  // a leaf of a group's tree, with one child
  row<std::uint64_t>(out, {kUndefined, kUndefined, 0, at.table, at.name[at.by_name.back()]});
  zeros(out, kTreeBytes - 48);

  out.text("HEAP");
  row<std::uint32_t>(out, {0});
  row<std::uint64_t>(out, {at.names_bytes, 1, at.names});  // 1: nothing is free
  zeros(out, 8);
  for (const Hdf5Array& array : arrays) {
    out.text(array.name);
    zeros(out, up_to_8(array.name.size() + 1) - array.name.size());
  }

  out.text("SNOD");
  row<std::uint16_t>(out, {1, static_cast<std::uint16_t>(arrays.size())});
  for (const std::size_t i : at.by_name) write_entry(out, at.name[i], at.header[i]);
  zeros(out, (2 * at.table_rank - arrays.size()) * kEntryBytes);
}

void write_type(ByteWriter& out, Hdf5Type type) {
  const bool real = type != Hdf5Type::kInt32;
  const bool wide = type == Hdf5Type::kFloat64;
  const auto bits = static_cast<std::uint16_t>(8 * bytes_of(type));
  begin_message(out, kDatatype, 24);
  // Version and class; signed, or normalised with the sign in the highest bit.
  row<std::uint8_t>(
      out, {static_cast<std::uint8_t>(real ? 0x11 : 0x10), static_cast<std::uint8_t>(real ? 0x20 : 0x08),
            static_cast<std::uint8_t>(real ? bits - 1 : 0), 0});
  out.raw(static_cast<std::uint32_t>(bytes_of(type)));
  row<std::uint16_t>(out, {0, bits});
  // Place and width of exponent and mantissa, and the exponent's bias.
  const std::uint8_t mantissa = wide ? 52 : 23;
  if (real)
    row<std::uint8_t>(out, {mantissa, static_cast<std::uint8_t>(wide ? 11 : 8), 0, mantissa});
  else
    zeros(out, 4);
  row<std::uint32_t>(out, {real ? (wide ? 1023U : 127U) : 0U, 0});
}

void write_array_header(ByteWriter& out, const Hdf5Array& array, std::uint64_t values) {
  const std::size_t rank = array.shape.size();
  begin_header(out, 4, header_bytes(array));
  begin_message(out, kDataspace, static_cast<std::uint16_t>(8 + 8 * rank));
  row<std::uint8_t>(out, {1, static_cast<std::uint8_t>(rank), 0, 0, 0, 0, 0, 0});
  for (const std::uint64_t extent : array.shape) out.raw(extent);
  write_type(out, array.type);
  begin_message(out, kFillValue, 8);
  row<std::uint8_t>(out, {2, 1, 1, 0, 0, 0, 0, 0});  // space is allocated, never filled, by nothing
  begin_message(out, kLayout, 24);
  row<std::uint8_t>(out, {3, 1});  // contiguous
  row<std::uint64_t>(out, {values, bytes_of(array)});
  zeros(out, 6);
}

}  // namespace

ByteWriter begin_hdf5(const std::vector<Hdf5Array>& arrays) {
  const Places at = place(arrays);
  ByteWriter out(static_cast<std::size_t>(at.end));
  write_superblock(out, at);
  write_group(out, at, arrays);
  for (std::size_t i = 0; i < arrays.size(); ++i) write_array_header(out, arrays[i], at.values[i]);
  return out;
}

}  // namespace voxtet
