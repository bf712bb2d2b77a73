#include "io/mesh/read/vtu_xml.h"

#include "io/bytes/header_text.h"
#include "io/mesh/read/shared/xml_tags.h"

namespace voxtet {
namespace {

/// Puts tags into their places.
class VtuBuilder {
 public:
  explicit VtuBuilder(std::string_view file) : file_(file), reader_(file, "VTKFile") {}

  bool build() {
    XmlTag tag;
    std::string_view text;
    do {
      if (!reader_.next(tag, text)) return false;
      if (array_ != nullptr && array_->text.empty()) array_->text = trimmed(text);
      if (tag.closing) {
        if (tag.name == "DataArray" || tag.name == "Array") array_ = nullptr;
      } else if (!open(tag)) {
        return false;
      }
    } while (!reader_.at_end() && document.appended_encoding.empty());
    return true;
  }
  const std::string& error() const { return reader_.error(); }

  VtuDocument document;

 private:
  bool open(const XmlTag& tag) {
    const std::string_view parent = reader_.parent();
    if (tag.name == "VTKFile") {
      document.grid_type = tag["type"];
      document.byte_order = tag["byte_order"];
      document.header_type = tag["header_type"];
      document.compressor = tag["compressor"];
    } else if (tag.name == "Piece") {
      document.pieces.push_back({tag["NumberOfPoints"], tag["NumberOfCells"], {}});
    } else if (tag.name == "DataArray" || tag.name == "Array") {
      if (parent != "FieldData" && document.pieces.empty())
        return reader_.fail("an array outside of a Piece");
      auto& arrays = parent == "FieldData" ? document.field_data : document.pieces.back().arrays;
      arrays.push_back({parent,
                        tag["Name"],
                        tag["type"],
                        tag["format"],
                        tag["offset"],
                        tag["NumberOfComponents"],
                        tag["NumberOfTuples"],
                        {}});
      array_ = tag.empty ? nullptr : &arrays.back();
    } else if (tag.name == "AppendedData") {
      return open_appended(tag);
    }
    return true;
  }

  bool open_appended(const XmlTag& tag) {
    document.appended_encoding = tag["encoding"];
    if (document.appended_encoding != "raw" && document.appended_encoding != "base64")
      return reader_.fail("AppendedData encoding " + in_quotes(document.appended_encoding) +
                          ", expected raw or base64");
    const std::size_t start = file_.find('_', reader_.position());
    if (start == std::string_view::npos ||
        !trimmed(file_.substr(reader_.position(), start - reader_.position())).empty())
      return reader_.fail("no \"_\" at the begin of AppendedData");
    document.appended = file_.substr(start + 1);
    return true;
  }

  std::string_view file_;
  XmlTags reader_;
  VtuArray* array_ = nullptr;
};

}  // namespace

Result<VtuDocument> parse_vtu_xml(std::string_view file) {
  VtuBuilder builder(file);
  if (!builder.build()) return Error{ErrorCode::kBadInput, "read_vtu", builder.error(), {}};
  return std::move(builder.document);
}

}  // namespace voxtet
