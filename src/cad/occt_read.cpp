// Reads shapes, names and colours of STEP and IGES files, and shapes of files of Open CASCADE.
#ifdef OMBRE_CAD

#include <BRepBuilderAPI_MakeSolid.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepLib.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <IGESCAFControl_Reader.hxx>
#include <IGESData_GlobalSection.hxx>
#include <IGESData_IGESModel.hxx>
#include <Quantity_ColorRGBA.hxx>
#include <STEPCAFControl_Reader.hxx>
#include <Standard_Failure.hxx>
#include <TColStd_SequenceOfAsciiString.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TDF_LabelSequence.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Solid.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string_view>

#include "base/system/not_copied.h"
#include "base/text/error.h"
#include "cad/occt_shapes.h"

namespace ombre::cad {
namespace {

// Distance in mm below which edges of two faces count as one.
constexpr double sewing_tolerance = 1e-3;

using Colour = std::array<uint8_t, 4>;
using OptionalColour = std::optional<Colour>;

// A document of the library; its application keeps it until it is closed.
class Document : NotCopied {
 public:
  Document() : application_(XCAFApp_Application::GetApplication()) {
    application_->NewDocument("MDTV-XCAF", document_);
  }
  ~Document() { application_->Close(document_); }

  opencascade::handle<TDocStd_Document>& handle() { return document_; }

 private:
  opencascade::handle<XCAFApp_Application> application_;
  opencascade::handle<TDocStd_Document> document_;
};

uint8_t byte(double share) { return static_cast<uint8_t>(std::lround(255 * std::clamp(share, 0.0, 1.0))); }

// Returns a colour encoded as sRGB, as in files and on screens.
Colour colour_of(const Quantity_ColorRGBA& rgba) {
  double red = 0, green = 0, blue = 0;
  rgba.GetRGB().Values(red, green, blue, Quantity_TOC_sRGB);
  return {byte(red), byte(green), byte(blue), byte(static_cast<double>(rgba.Alpha()))};
}

std::string name_of(const TDF_Label& label) {
  opencascade::handle<TDataStd_Name> name;
  if (!label.FindAttribute(TDataStd_Name::GetID(), name)) return "";
  const TCollection_ExtendedString& text = name->Get();
  std::string utf8(static_cast<size_t>(text.LengthOfCString()) + 1, '\0');
  Standard_PCharacter begin = utf8.data();
  utf8.resize(static_cast<size_t>(text.ToUTF8CString(begin)));
  return utf8;
}

// The solids of a file, and the faces that belong to no solid.
struct Found {
  std::vector<NamedShape> solids, faces;
};

// Collects the shapes of a document.
class Collector {
 public:
  explicit Collector(const opencascade::handle<TDocStd_Document>& document)
      : shapes_(XCAFDoc_DocumentTool::ShapeTool(document->Main())),
        colours_(XCAFDoc_DocumentTool::ColorTool(document->Main())) {}

  Found run() {
    TDF_LabelSequence roots;
    shapes_->GetFreeShapes(roots);
    for (const TDF_Label& root : roots) add(root, TopLoc_Location(), "", {});
    return std::move(found_);
  }

 private:
  void add(const TDF_Label& label, const TopLoc_Location& place, const std::string& outer_name,
           const OptionalColour& outer_colour) {
    // An instance's own colour takes precedence over that of the shape that it instantiates.
    const OptionalColour own = colour_of_label(label);
    const OptionalColour colour = outer_colour ? outer_colour : own;
    TDF_Label referred;
    if (XCAFDoc_ShapeTool::IsReference(label) && XCAFDoc_ShapeTool::GetReferredShape(label, referred)) {
      add(referred, place * XCAFDoc_ShapeTool::GetLocation(label), name_of(label), colour);
      return;
    }
    const std::string name = name_of(label).empty() ? outer_name : name_of(label);
    TDF_LabelSequence components;
    if (XCAFDoc_ShapeTool::IsAssembly(label) && XCAFDoc_ShapeTool::GetComponents(label, components)) {
      for (const TDF_Label& component : components) add(component, place, name, colour);
      return;
    }
    add_shape(label, place, name, colour);
  }

  void add_shape(const TDF_Label& label, const TopLoc_Location& place, const std::string& name,
                 const OptionalColour& colour) {
    const TopoDS_Shape whole = XCAFDoc_ShapeTool::GetShape(label);
    for (TopExp_Explorer e(whole, TopAbs_SOLID); e.More(); e.Next()) {
      const TopoDS_Shape& solid = e.Current();
      TDF_Label own;
      const bool has_label = shapes_->FindSubShape(label, solid, own);
      const std::string own_name = has_label ? name_of(own) : "";
      OptionalColour own_colour = has_label ? colour_of_label(own) : OptionalColour();
      if (!own_colour) own_colour = colour ? colour : first_colour(solid);
      found_.solids.push_back({own_name.empty() ? name : own_name, own_colour, solid.Moved(place)});
    }
    for (TopExp_Explorer e(whole, TopAbs_FACE, TopAbs_SOLID); e.More(); e.Next()) {
      const OptionalColour own = colour_of_shape(e.Current());
      found_.faces.push_back({name, own ? own : colour, e.Current().Moved(place)});
    }
  }

  OptionalColour colour_of_label(const TDF_Label& label) const {
    Quantity_ColorRGBA rgba;
    for (const XCAFDoc_ColorType type : {XCAFDoc_ColorSurf, XCAFDoc_ColorGen})
      if (colours_->GetColor(label, type, rgba)) return colour_of(rgba);
    return std::nullopt;
  }

  OptionalColour colour_of_shape(const TopoDS_Shape& shape) const {
    Quantity_ColorRGBA rgba;
    for (const XCAFDoc_ColorType type : {XCAFDoc_ColorSurf, XCAFDoc_ColorGen})
      if (colours_->GetColor(shape, type, rgba)) return colour_of(rgba);
    return std::nullopt;
  }

  // Many programs assign colours only to faces.
  OptionalColour first_colour(const TopoDS_Shape& solid) const {
    for (TopExp_Explorer e(solid, TopAbs_FACE); e.More(); e.Next())
      if (const OptionalColour colour = colour_of_shape(e.Current())) return colour;
    return std::nullopt;
  }

  opencascade::handle<XCAFDoc_ShapeTool> shapes_;
  opencascade::handle<XCAFDoc_ColorTool> colours_;
  Found found_;
};

// Returns the solids of closed shells into which the faces can be sewn.
std::vector<NamedShape> sewn(const std::vector<NamedShape>& faces) {
  BRepBuilderAPI_Sewing sewing(sewing_tolerance);
  for (const NamedShape& face : faces) sewing.Add(face.shape);
  sewing.Perform();
  std::vector<NamedShape> solids;
  for (TopExp_Explorer e(sewing.SewedShape(), TopAbs_SHELL); e.More(); e.Next()) {
    if (!BRep_Tool::IsClosed(e.Current())) continue;
    TopoDS_Solid solid = BRepBuilderAPI_MakeSolid(TopoDS::Shell(e.Current()));
    BRepLib::OrientClosedSolid(solid);
    TopTools_IndexedMapOfShape own;
    TopExp::MapShapes(e.Current(), TopAbs_FACE, own);
    solids.push_back({"", {}, solid, faces.front().unit});
    // Open CASCADE 7.8 does not report the colours of all faces of an IGES file.
    for (const NamedShape& face : faces) {
      if (!own.Contains(sewing.Modified(face.shape))) continue;
      if (solids.back().name.empty()) solids.back().name = face.name;
      if (!solids.back().colour) solids.back().colour = face.colour;
    }
  }
  return solids;
}

template <class Reader>
void read_with(Reader& reader, const std::string& path, Document& document) {
  reader.SetColorMode(true);
  reader.SetNameMode(true);
  const IFSelect_ReturnStatus status = reader.ReadFile(path.c_str());
  if (status != IFSelect_RetDone)
    throw Error(Code::cannot_read,
                "cannot read " + path + ": it is no valid file of its kind; export it again, as STEP AP214 or AP242",
                {{"file", path}});
  if (!reader.Transfer(document.handle()))
    throw Error(Code::cannot_read, "cannot read " + path + ": it holds no shapes; export the part as a solid",
                {{"file", path}});
}

std::string unit_of(STEPCAFControl_Reader& reader) {
  TColStd_SequenceOfAsciiString lengths, angles, solid_angles;
  reader.ChangeReader().FileUnits(lengths, angles, solid_angles);
  return lengths.IsEmpty() ? "" : lengths.First().ToCString();
}

std::string unit_of(const IGESCAFControl_Reader& reader) {
  const auto name = reader.IGESModel()->GlobalSection().UnitName();
  return name.IsNull() ? "" : name->ToCString();
}

// Keeps the library from printing while it lives.
class QuietOutput : NotCopied {
 public:
  QuietOutput() : printed_(std::cout.rdbuf(nullptr)) {}
  ~QuietOutput() { std::cout.rdbuf(printed_); }

 private:
  std::streambuf* printed_;
};

// Returns false if the file lacks its last line, which says what shape it holds by an orientation, a number and a
// place, for example "+1 0". Of such a file the library goes on reading for minutes.
bool has_last_line(const std::string& path) {
  constexpr std::streamoff longest = 64;
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  file.seekg(-std::min<std::streamoff>(longest, file.tellg()), std::ios::end);
  std::string last, line;
  while (std::getline(file, line))
    if (line.find_first_not_of(" \r") != std::string::npos) last = line;
  std::istringstream in(last);
  char orientation = 0;
  int number = 0, place = 0;
  return in >> orientation >> number >> place && std::string_view("+-ie").find(orientation) != std::string_view::npos;
}

bool read_shape(const std::string& path, TopoDS_Shape& shape) {
  const QuietOutput quiet;
  try {
    return has_last_line(path) && BRepTools::Read(shape, path.c_str(), BRep_Builder()) && !shape.IsNull();
  } catch (const Standard_Failure&) {
    return false;
  }
}

// Reads a file of Open CASCADE, which has neither names nor colours, and lengths in mm.
Found read_brep(const std::string& path) {
  TopoDS_Shape whole;
  if (!read_shape(path, whole))
    throw Error(
        Code::cannot_read,
        "cannot read " + path + ": it is cut off, or no file of its kind; write it again by Open CASCADE, or as STEP",
        {{"file", path}});
  Found found;
  for (TopExp_Explorer e(whole, TopAbs_SOLID); e.More(); e.Next()) found.solids.push_back({"", {}, e.Current(), "mm"});
  for (TopExp_Explorer e(whole, TopAbs_FACE, TopAbs_SOLID); e.More(); e.Next())
    found.faces.push_back({"", {}, e.Current(), "mm"});
  return found;
}

template <class Reader>
Found read_document(const std::string& path) {
  Document document;
  Reader reader;
  read_with(reader, path, document);
  Found found = Collector(document.handle()).run();
  for (std::vector<NamedShape>* const shapes : {&found.solids, &found.faces})
    for (NamedShape& shape : *shapes) shape.unit = unit_of(reader);
  return found;
}

// Returns the first letter of the ending, which tells the formats of cad_library.cpp apart.
char kind_of(const std::string& path) {
  const size_t dot = path.rfind('.');
  if (dot == std::string::npos || dot + 1 == path.size()) return ' ';
  return static_cast<char>(std::tolower(static_cast<unsigned char>(path[dot + 1])));
}

Found read_file(const std::string& path) {
  const char kind = kind_of(path);
  if (kind == 'b') return read_brep(path);
  if (kind == 'i') return read_document<IGESCAFControl_Reader>(path);
  return read_document<STEPCAFControl_Reader>(path);
}

}  // namespace

std::vector<NamedShape> read_shapes(const std::string& path) {
  Found found = read_file(path);
  if (!found.faces.empty()) {
    std::vector<NamedShape> closed = sewn(found.faces);
    found.solids.insert(found.solids.end(), closed.begin(), closed.end());
  }
  if (!found.solids.empty()) return found.solids;
  if (found.faces.empty())
    throw Error(Code::file_content, path + " holds no solid; export the part as a solid", {{"file", path}});
  throw Error(Code::file_content,
              path + " holds " + std::to_string(found.faces.size()) +
                  (found.faces.size() == 1 ? " surface" : " surfaces") +
                  " and no solid, and they do not close; export the part as a solid",
              {{"file", path}});
}

}  // namespace ombre::cad

#endif
