// Serializes shapes, for the transfer from a helper process.
#ifdef OMBRE_CAD

#include <BRep_Builder.hxx>
#include <BinTools.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Iterator.hxx>
#include <sstream>

#include "base/system/byte_pack.h"
#include "cad/occt_shapes.h"

namespace ombre::cad {

std::string pack_shapes(const std::vector<MeasuredShape>& shapes) {
  TopoDS_Compound all;
  const BRep_Builder builder;
  builder.MakeCompound(all);
  BytePacker packer;
  packer.add(uint64_t{shapes.size()});
  for (const MeasuredShape& shape : shapes) {
    builder.Add(all, shape.named.shape);
    packer.add_text(shape.named.name);
    packer.add_text(shape.named.unit);
    packer.add(shape.named.colour.has_value());
    packer.add(shape.named.colour.value_or(std::array<uint8_t, 4>{}));
    packer.add(shape.volume_mm3);
    packer.add(shape.bounds);
  }
  std::ostringstream stream;
  BinTools::Write(all, stream);
  packer.add_text(stream.str());
  return packer.take();
}

std::vector<MeasuredShape> unpack_shapes(const std::string& bytes) {
  ByteUnpacker unpacker(bytes);
  std::vector<MeasuredShape> shapes(unpacker.get<uint64_t>());
  for (MeasuredShape& shape : shapes) {
    shape.named.name = unpacker.get_text();
    shape.named.unit = unpacker.get_text();
    const bool has_colour = unpacker.get<bool>();
    const auto colour = unpacker.get<std::array<uint8_t, 4>>();
    if (has_colour) shape.named.colour = colour;
    shape.volume_mm3 = unpacker.get<double>();
    shape.bounds = unpacker.get<Box>();
  }
  std::istringstream stream{std::string(unpacker.get_text())};
  TopoDS_Shape all;
  BinTools::Read(all, stream);
  TopoDS_Iterator part(all);
  for (MeasuredShape& shape : shapes) {
    if (!part.More()) throw Error(Code::other_program, "a helper process sent too few shapes");
    shape.named.shape = part.Value();
    part.Next();
  }
  return shapes;
}

}  // namespace ombre::cad

#endif
