// Joins the triangulated faces of a shape along their edges.
#ifdef OMBRE_CAD

#include "cad/occt_triangles.h"

#include <BRep_Tool.hxx>
#include <Poly_PolygonOnTriangulation.hxx>
#include <Poly_Triangulation.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Vertex.hxx>
#include <limits>

#include "base/text/error.h"

namespace ombre::cad {
namespace {

constexpr uint32_t unknown = std::numeric_limits<uint32_t>::max();

class Joiner {
 public:
  explicit Joiner(const TopoDS_Shape& shape) {
    TopExp::MapShapes(shape, TopAbs_EDGE, edges_);
    TopExp::MapShapes(shape, TopAbs_VERTEX, corners_);
    of_edges_.resize(static_cast<size_t>(edges_.Extent()));
    of_corners_.resize(static_cast<size_t>(corners_.Extent()), unknown);
  }

  // Adds a face. Returns false if it has no triangles.
  bool add(const TopoDS_Face& face) {
    TopLoc_Location place;
    const opencascade::handle<Poly_Triangulation> mesh = BRep_Tool::Triangulation(face, place);
    if (mesh.IsNull() || mesh->NbTriangles() == 0) return false;
    mesh_ = mesh.get();
    move_ = place.Transformation();
    numbers_.assign(static_cast<size_t>(mesh->NbNodes()), unknown);
    for (TopExp_Explorer e(face, TopAbs_EDGE); e.More(); e.Next()) join(TopoDS::Edge(e.Current()), mesh, place);
    for (Standard_Integer n = 1; n <= mesh->NbNodes(); ++n) number(n);
    const bool is_turned = face.Orientation() == TopAbs_REVERSED;
    for (Standard_Integer t = 1; t <= mesh->NbTriangles(); ++t) add_triangle(mesh->Triangle(t), is_turned);
    ++face_count_;
    return true;
  }

  Triangles take() { return std::move(result_); }

 private:
  // The nodes of an edge have the same order and positions in both faces.
  void join(const TopoDS_Edge& edge, const opencascade::handle<Poly_Triangulation>& mesh,
            const TopLoc_Location& place) {
    const opencascade::handle<Poly_PolygonOnTriangulation> polygon =
        BRep_Tool::PolygonOnTriangulation(edge, mesh, place);
    if (polygon.IsNull()) return;
    const Standard_Integer count = polygon->NbNodes();
    std::vector<uint32_t>& shared = of_edges_[static_cast<size_t>(edges_.FindIndex(edge) - 1)];
    if (shared.empty()) shared.assign(static_cast<size_t>(count), unknown);
    if (shared.size() != static_cast<size_t>(count)) return;
    TopoDS_Vertex first, last;
    TopExp::Vertices(TopoDS::Edge(edge.Oriented(TopAbs_FORWARD)), first, last);
    const bool is_point = BRep_Tool::Degenerated(edge);
    for (Standard_Integer n = 1; n <= count; ++n) {
      const bool is_first = n == 1 || is_point, is_end = is_first || n == count;
      uint32_t* slot = &shared[static_cast<size_t>(n - 1)];
      if (is_end && !first.IsNull() && !last.IsNull()) slot = &of_corners_[corner(is_first ? first : last)];
      if (*slot == unknown) *slot = number(polygon->Node(n));
      numbers_[static_cast<size_t>(polygon->Node(n) - 1)] = *slot;
    }
  }

  size_t corner(const TopoDS_Vertex& vertex) const { return static_cast<size_t>(corners_.FindIndex(vertex) - 1); }

  // Returns the number of the vertex of a node of the face.
  uint32_t number(Standard_Integer node) {
    uint32_t& known = numbers_[static_cast<size_t>(node - 1)];
    if (known != unknown) return known;
    const gp_Pnt p = mesh_->Node(node).Transformed(move_);
    known = static_cast<uint32_t>(result_.vertices.size());
    result_.vertices.push_back({p.X(), p.Y(), p.Z()});
    return known;
  }

  // Adds a triangle unless two of its corners are equal, as at edges of length 0.
  void add_triangle(const Poly_Triangle& triangle, bool is_turned) {
    Standard_Integer a = 0, b = 0, c = 0;
    triangle.Get(a, b, c);
    if (is_turned) std::swap(b, c);
    const std::array<uint32_t, 3> corners{number(a), number(b), number(c)};
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) return;
    result_.triangles.push_back(corners);
    result_.faces.push_back(face_count_);
  }

  TopTools_IndexedMapOfShape edges_, corners_;
  std::vector<std::vector<uint32_t>> of_edges_;
  std::vector<uint32_t> of_corners_;
  // State of the face that is being added:
  const Poly_Triangulation* mesh_ = nullptr;
  gp_Trsf move_;
  std::vector<uint32_t> numbers_;  // by node: number of its vertex
  Triangles result_;
  uint32_t face_count_ = 0;  // number of faces added before
};

}  // namespace

Triangles triangles_of(const TopoDS_Shape& shape, const std::string& what) {
  Joiner joiner(shape);
  for (TopExp_Explorer e(shape, TopAbs_FACE); e.More(); e.Next())
    if (!joiner.add(TopoDS::Face(e.Current())))
      throw Error(Code::file_content,
                  what + " has a face that Open CASCADE cannot cut into triangles; repair it where it was drawn");
  return joiner.take();
}

}  // namespace ombre::cad

#endif
