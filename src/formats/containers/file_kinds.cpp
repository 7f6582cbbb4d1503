// Recognizes files that are given as meshes but have another format.
#include "formats/containers/file_kinds.h"

#include <algorithm>

#include "base/text/text.h"

namespace ombre::formats {
namespace {

constexpr std::string_view unpack = "unpack it";

struct Kind {
  std::string_view begin;  // first bytes of the file
  std::string_view what;
  std::string_view hint = {};
  bool is_other_mesh = false;
};

using namespace std::string_view_literals;

constexpr Kind kinds[]{
    {"version https://git-lfs.github.com/spec/", "a pointer of Git LFS, not the file itself",
     "fetch the file: git lfs pull"},
    {"ISO-10303-21"sv, "a STEP file", "write cad in place of mesh, and name it .step"},
    {"\x89PNG"sv, "a PNG picture", "relief makes a solid of a picture"},
    {"\xFF\xD8\xFF"sv, "a JPEG picture"},
    {"GIF8"sv, "a GIF picture"},
    {"%PDF"sv, "a PDF document"},
    {"\x1F\x8B"sv, "packed by gzip", unpack},
    {"BZh"sv, "packed by bzip2", unpack},
    {"\xFD"
     "7zXZ"sv,
     "packed by xz", unpack},
    {"\x28\xB5\x2F\xFD"sv, "packed by zstd", unpack},
    {"7z\xBC\xAF"sv, "a 7-Zip archive", unpack},
    {"Rar!"sv, "a RAR archive", unpack},
    {"PK\x05\x06"sv, "an empty zip archive"},
    {"glTF\x02\0\0\0"sv, "a glTF file", {}, true},
    {"Kaydara FBX Binary"sv, "an FBX file", {}, true},
    {"BLENDER"sv, "a Blender file", {}, true},
    {"\xD0\xCF\x11\xE0"sv, "a document of SolidWorks, Inventor or Office", {}, true},
    {"#VRML"sv, "a VRML file", {}, true},
    {"# vtk DataFile"sv, "a legacy file of VTK", "save it as .vtu, .vti or .stl, by ParaView for example"},
    {"SQLite format 3"sv, "a database"},
    {"\x7F"
     "ELF"sv,
     "a program"},
    {"{"sv, "JSON"},
    {"\xFF\xFE"sv, "text in UTF-16", "save it as UTF-8"},
    {"\xFE\xFF"sv, "text in UTF-16", "save it as UTF-8"},
};

bool begins_with(std::string_view text, std::string_view word) { return to_lower(text.substr(0, word.size())) == word; }

}  // namespace

std::optional<ForeignFile> foreign_file(std::string_view bytes) {
  for (const Kind& kind : kinds)
    if (bytes.starts_with(kind.begin))
      return ForeignFile{std::string(kind.what), std::string(kind.hint), kind.is_other_mesh};
  constexpr size_t sniffed_bytes = 1024;
  std::string_view text = bytes.substr(0, sniffed_bytes);
  text.remove_prefix(std::min(text.find_first_not_of("\xEF\xBB\xBF \t\r\n"), text.size()));
  if (begins_with(text, "<!doctype html") || begins_with(text, "<html"))
    return ForeignFile{"an HTML page, perhaps an error message of a server", "download the file again"};
  return std::nullopt;
}

bool has_zeros(std::string_view bytes) {
  const size_t last = bytes.find_last_not_of('\0');
  return last != std::string_view::npos && bytes.substr(0, last).find('\0') != std::string_view::npos;
}

bool is_plain_text(std::string_view bytes) {
  return std::all_of(bytes.begin(), bytes.end(), [](char c) {
    const auto code = static_cast<unsigned char>(c);
    return (code >= 0x20 && code != 0x7F) || (code >= '\t' && code <= '\r');
  });
}

}  // namespace ombre::formats
