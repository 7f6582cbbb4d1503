// Makes the CAD files of examples and tests: ninja -C build/dev make_cad_models && build/dev/tools/make_cad_models .
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <GeomAPI_PointsToBSpline.hxx>
#include <Geom_BSplineCurve.hxx>
#include <IGESCAFControl_Writer.hxx>
#include <Interface_Static.hxx>
#include <STEPCAFControl_Writer.hxx>
#include <STEPControl_Controller.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <gp_Ax1.hxx>
#include <gp_Ax2.hxx>
#include <gp_Trsf.hxx>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace {

struct Item {
  std::string name;
  TopoDS_Shape shape;
  std::optional<Quantity_Color> colour;
};

Quantity_Color colour(int red, int green, int blue) {
  return {red / 255.0, green / 255.0, blue / 255.0, Quantity_TOC_sRGB};
}

opencascade::handle<TDocStd_Document> new_document() {
  opencascade::handle<TDocStd_Document> document;
  XCAFApp_Application::GetApplication()->NewDocument("MDTV-XCAF", document);
  return document;
}

void write(const std::string& path, const opencascade::handle<TDocStd_Document>& document, const char* unit) {
  bool good = false;
  if (path.ends_with(".iges")) {
    IGESCAFControl_Writer writer;
    writer.Transfer(document);
    writer.ComputeModel();
    good = writer.Write(path.c_str());
  } else {
    const STEPControl_Controller settings;
    Interface_Static::SetCVal("write.step.unit", unit);
    STEPCAFControl_Writer writer;
    writer.Transfer(document);
    good = writer.Write(path.c_str()) == IFSelect_RetDone;
  }
  if (good) return;
  std::fprintf(stderr, "cannot write %s\n", path.c_str());
  std::exit(1);
}

void write(const std::string& path, const std::vector<Item>& items, const char* unit = "MM") {
  const auto document = new_document();
  const auto shapes = XCAFDoc_DocumentTool::ShapeTool(document->Main());
  const auto colours = XCAFDoc_DocumentTool::ColorTool(document->Main());
  for (const Item& item : items) {
    const TDF_Label label = shapes->AddShape(item.shape, false);
    TDataStd_Name::Set(label, item.name.c_str());
    if (item.colour) colours->SetColor(label, *item.colour, XCAFDoc_ColorSurf);
  }
  write(path, document, unit);
}

// Two instances of one solid: one where it is, a green one turned about y by 90 degrees and moved.
void write_assembly(const std::string& path, const TopoDS_Shape& solid) {
  const auto document = new_document();
  const auto shapes = XCAFDoc_DocumentTool::ShapeTool(document->Main());
  const TDF_Label part = shapes->AddShape(solid, false), whole = shapes->NewShape();
  TDataStd_Name::Set(part, "bolt");
  TDataStd_Name::Set(whole, "pair");
  gp_Trsf turn, move;
  turn.SetRotation(gp_Ax1({0, 0, 0}, {0, 1, 0}), std::numbers::pi / 2);
  move.SetTranslation({20, 0, 0});
  shapes->AddComponent(whole, part, TopLoc_Location());
  const TDF_Label second = shapes->AddComponent(whole, part, TopLoc_Location(move * turn));
  XCAFDoc_DocumentTool::ColorTool(document->Main())->SetColor(second, colour(0, 255, 0), XCAFDoc_ColorSurf);
  shapes->UpdateAssemblies();
  write(path, document, "MM");
}

TopoDS_Shape box(gp_Pnt corner, gp_Pnt opposite) { return BRepPrimAPI_MakeBox(corner, opposite).Shape(); }

TopoDS_Shape cylinder(gp_Pnt foot, gp_Dir along, double radius, double height) {
  return BRepPrimAPI_MakeCylinder(gp_Ax2(foot, along), radius, height).Shape();
}

TopoDS_Shape cut(const TopoDS_Shape& from, const TopoDS_Shape& tool) { return BRepAlgoAPI_Cut(from, tool).Shape(); }

// Edges along y through the point (x, z).
void add_edges(BRepFilletAPI_MakeFillet& fillet, const TopoDS_Shape& shape, double x, double z, double radius) {
  for (TopExp_Explorer e(shape, TopAbs_EDGE); e.More(); e.Next()) {
    const TopoDS_Edge edge = TopoDS::Edge(e.Current());
    const gp_Pnt a = BRep_Tool::Pnt(TopExp::FirstVertex(edge)), b = BRep_Tool::Pnt(TopExp::LastVertex(edge));
    const auto is_there = [&](const gp_Pnt& p) { return std::abs(p.X() - x) + std::abs(p.Z() - z) < 1e-6; };
    if (is_there(a) && is_there(b)) {
      fillet.Add(radius, edge);
      return;
    }
  }
}

// A plate with two holes for screws and an upright with a larger one, rounded where they meet.
TopoDS_Shape bracket() {
  BRepBuilderAPI_MakePolygon outline;
  for (const auto& [x, z] : {std::pair{0, 0}, {40, 0}, {40, 4}, {4, 4}, {4, 30}, {0, 30}}) outline.Add(gp_Pnt(x, 0, z));
  outline.Close();
  const TopoDS_Shape angle =
      BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(outline.Wire()).Face(), gp_Vec(0, 24, 0)).Shape();
  BRepFilletAPI_MakeFillet fillet(angle);
  add_edges(fillet, angle, 4, 4, 6);
  add_edges(fillet, angle, 0, 0, 8);
  add_edges(fillet, angle, 40, 4, 2);
  TopoDS_Shape shape = fillet.Shape();
  for (const double y : {6.0, 18.0}) shape = cut(shape, cylinder({30, y, -1}, {0, 0, 1}, 2.2, 6));
  return cut(shape, cylinder({-1, 12, 20}, {1, 0, 0}, 6, 6));
}

TopoDS_Shape bushing() {
  return cut(cylinder({-2, 12, 20}, {1, 0, 0}, 6, 8), cylinder({-3, 12, 20}, {1, 0, 0}, 4, 10));
}

// Planes, a cylinder, a cone, a sphere, a torus and a spline's walls, mirrored.
TopoDS_Shape all_surfaces() {
  TopoDS_Shape shape = cut(box({0, 0, 0}, {30, 20, 10}), cylinder({5, 5, -1}, {0, 0, 1}, 3, 12));
  shape = cut(shape, BRepPrimAPI_MakeCone(gp_Ax2({15, 5, 4}, {0, 0, 1}), 0, 4, 8).Shape());
  shape = cut(shape, BRepPrimAPI_MakeSphere(gp_Pnt(25, 6, 11), 4).Shape());
  shape = cut(shape, BRepPrimAPI_MakeTorus(gp_Ax2({8, 14, 10}, {0, 0, 1}), 4, 1.5).Shape());
  TColgp_Array1OfPnt points(1, 4);
  points.SetValue(1, {18, 21, -1});
  points.SetValue(2, {20, 8, -1});
  points.SetValue(3, {24, 20, -1});
  points.SetValue(4, {29, 21, -1});
  const TopoDS_Edge curve = BRepBuilderAPI_MakeEdge(GeomAPI_PointsToBSpline(points).Curve());
  const TopoDS_Edge back = BRepBuilderAPI_MakeEdge(points.Value(4), points.Value(1));
  const TopoDS_Face foot = BRepBuilderAPI_MakeFace(BRepBuilderAPI_MakeWire(curve, back).Wire());
  shape = cut(shape, BRepPrimAPI_MakePrism(foot, gp_Vec(0, 0, 12)).Shape());
  gp_Trsf mirror;
  mirror.SetMirror(gp_Ax2({0, 0, 0}, {1, 0, 0}));
  return BRepBuilderAPI_Transform(shape, mirror).Shape();
}

TopoDS_Shape without_one_face(const TopoDS_Shape& shape) {
  TopoDS_Compound faces;
  const BRep_Builder builder;
  builder.MakeCompound(faces);
  TopExp_Explorer e(shape, TopAbs_FACE);
  for (e.Next(); e.More(); e.Next()) builder.Add(faces, e.Current());
  return faces;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string root = argc > 1 ? argv[1] : ".", tests = root + "/tests/cad/";
  write(root + "/examples/models/bracket.step",
        {{"bracket", bracket(), colour(150, 150, 155)}, {"bushing", bushing(), colour(220, 30, 40)}});
  write(tests + "cylinder.step", {{"cylinder", cylinder({0, 0, 0}, {0, 0, 1}, 5, 20), {}}});
  write(tests + "sphere.step", {{"sphere", BRepPrimAPI_MakeSphere(gp_Pnt(1, 2, 3), 4).Shape(), {}}});
  const TopoDS_Shape block = cut(box({0, 0, 0}, {20, 10, 10}), cylinder({10, 5, -1}, {0, 0, 1}, 3, 12));
  write(tests + "block_in_inches.step", {{"block", block, {}}}, "INCH");
  write(tests + "block.iges", {{"block", block, {}}});
  const std::vector<Item> pair{{"base", box({0, 0, 0}, {10, 10, 5}), colour(255, 0, 0)},
                               {"pin", cylinder({5, 5, 5}, {0, 0, 1}, 2, 10), colour(0, 0, 255)}};
  write(tests + "base_and_pin.step", pair);
  write(tests + "base_and_pin.iges", pair);
  write(tests + "all_surfaces.step", {{"all surfaces", all_surfaces(), {}}});
  write_assembly(tests + "assembly.step", cylinder({0, 0, 0}, {0, 0, 1}, 2, 10));
  write(tests + "open_box.step", {{"open box", without_one_face(box({0, 0, 0}, {10, 10, 10})), {}}});
}
