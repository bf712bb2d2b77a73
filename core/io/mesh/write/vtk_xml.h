// The XML part of a VTK file whose arrays follow it, raw (VTK file formats, "XML File Formats").
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

#include "io/bytes/byte_writer.h"

namespace voxtet {

/// Declares the appended arrays in the order in which their bytes must follow, the size of each (UInt64)
/// before them, and then kFooter.
class VtkXml {
 public:
  static constexpr const char* kFooter = "\n</AppendedData>\n</VTKFile>\n";

  /// `grid`: UnstructuredGrid or PolyData. `piece`: the attributes of its only piece.
  VtkXml(std::string grid, const std::string& comment, const std::string& field_data,
         const std::string& piece)
      : grid_(std::move(grid)) {
    xml_ = "<?xml version=\"1.0\"?>\n<!-- " + comment + " -->\n<VTKFile type=\"" + grid_ +
           "\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<" + grid_ + ">\n";
    if (!field_data.empty()) xml_ += "<FieldData>\n" + field_data + "</FieldData>\n";
    xml_ += "<Piece " + piece + ">\n";
  }
  void open(const std::string& tag) { xml_ += "<" + tag + ">\n"; }
  /// `shape` is left away for scalars: meshio would make a column of them.
  void array(const std::string& type, const std::string& name, std::size_t bytes,
             const std::string& shape = "") {
    xml_ += "<DataArray type=\"" + type + "\" Name=\"" + name + "\"" + shape +
            " format=\"appended\" offset=\"" + std::to_string(offset_) + "\"/>\n";
    offset_ += sizeof(std::uint64_t) + bytes;
  }
  /// A writer that holds the finished XML and expects exactly the declared arrays.
  ByteWriter finish() {
    xml_ += "</Piece>\n</" + grid_ + ">\n<AppendedData encoding=\"raw\">\n_";
    ByteWriter writer(xml_.size() + offset_ + 64);
    writer.text(xml_);
    return writer;
  }

 private:
  std::string grid_, xml_;
  std::size_t offset_ = 0;
};

}  // namespace voxtet
