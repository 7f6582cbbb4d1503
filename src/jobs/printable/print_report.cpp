#include "jobs/printable/print_report.h"

#include <algorithm>
#include <cmath>

#include "base/text/text.h"
#include "jobs/slice/channel_counts.h"
#include "jobs/stacks/marked_layer.h"
#include "jobs/stacks/report_page.h"

namespace ombre::jobs {
namespace {

using compile::FlagPiece;
using compile::PrintFinding;

Box box_of(const FlagPiece& piece, const voxel::Lattice& lattice) { return voxel::part_of(lattice, piece.box).box(); }

double volume_mm3(uint64_t voxels, const voxel::Lattice& lattice) {
  return static_cast<double>(voxels) * compile::voxel_mm3(lattice);
}

std::string corner(const Vec3& p) {
  return '(' + format_rounded(p.x) + ", " + format_rounded(p.y) + ", " + format_rounded(p.z) + ')';
}

std::string extent(const FlagPiece& piece, const voxel::Lattice& lattice) {
  const Box box = box_of(piece, lattice);
  return "from " + corner(box.lo) + " to " + corner(box.hi) + " mm";
}

std::string line(const PrintFinding& finding, const voxel::Lattice& lattice) {
  const compile::FlagPieces& pieces = finding.pieces;
  std::string text = finding.text + ": " + format_count(pieces.count) + (pieces.count == 1 ? " place, " : " places, ") +
                     format_rounded(volume_mm3(pieces.voxels, lattice)) + " mm3";
  if (!pieces.largest.empty())
    text += pieces.count == 1 ? ", " + extent(pieces.largest.front(), lattice)
                              : "; the largest " + extent(pieces.largest.front(), lattice);
  return text;
}

std::string verdict(const CheckedPart& part) {
  const auto errors = static_cast<size_t>(std::ranges::count_if(part.findings, &PrintFinding::is_error));
  if (part.findings.empty()) return "nothing was found";
  if (errors == 0) return "nothing stands in the way";
  return format_count(errors) + (errors == 1 ? " thing stands" : " things stand") + " in the way";
}

Data corner_data(const Vec3& p) { return DataList{p.x, p.y, p.z}; }

Data places_data(const PrintFinding& finding, const voxel::Lattice& lattice) {
  DataList places;
  for (const FlagPiece& piece : finding.pieces.largest) {
    const Box box = box_of(piece, lattice);
    places.emplace_back(DataMembers{{"box_mm", DataList{corner_data(box.lo), corner_data(box.hi)}},
                                    {"volume_mm3", volume_mm3(piece.voxels, lattice)}});
  }
  return places;
}

std::string picture(const PrintFinding& finding, const compile::Plan& plan, const StopFlag* stop) {
  const compile::SliceRequest& request = plan.request;
  const auto& count = request.lattice.count;
  const auto layers = plan.producer(finding.layer, finding.layer + 1, stop);
  const auto& runs = std::get<RunLayer>(layers.front().channels.front());
  const auto width = static_cast<size_t>(count[0]), height = static_cast<size_t>(count[1]);
  std::vector<MaterialId> voxels(width * height);
  std::vector<uint8_t> flags(width * height);
  for (size_t j = 0; j < height; ++j) {
    runs.row(static_cast<uint32_t>(j)).unpack(voxels.data() + j * width);
    for (size_t i = 0; i < width; ++i)
      flags[j * width + i] = finding.flags.get(static_cast<int64_t>(i), static_cast<int64_t>(j)) ? 1 : 0;
  }
  const auto colour = [&](size_t voxel) {
    const auto material = std::ranges::find(request.materials, voxels[voxel], &compile::SliceMaterial::id);
    return material == request.materials.end() ? formats::Rgba{0, 0, 0, 0} : material->rgba;
  };
  return compile::marked_layer(request.lattice, colour, flags);
}

// Returns the volume that each material gains, less what it loses.
std::vector<std::pair<std::string, double>> gained_mm3(const compile::Correction& correction,
                                                       const compile::SliceRequest& request) {
  std::vector<std::pair<std::string, double>> volumes;
  for (const compile::SliceMaterial& material : request.materials) {
    const auto gained = correction.gained.find(material.id);
    if (gained == correction.gained.end()) continue;
    volumes.emplace_back(material.name, static_cast<double>(gained->second) * compile::voxel_mm3(request.lattice));
  }
  return volumes;
}

}  // namespace

DataList describe(const std::vector<compile::Correction>& corrections, const compile::SliceRequest& request) {
  DataList list;
  for (const compile::Correction& correction : corrections) {
    DataMembers gained;
    for (const auto& [name, mm3] : gained_mm3(correction, request)) gained.emplace_back(name, mm3);
    list.emplace_back(
        DataMembers{{"kind", correction.kind}, {"text", correction.text}, {"gained_mm3", std::move(gained)}});
  }
  return list;
}

void tell_corrections(const Events& events, const std::vector<compile::Correction>& corrections,
                      const compile::SliceRequest& request) {
  if (events.wants_data()) return events.event("corrected", {{"corrections", describe(corrections, request)}});
  if (corrections.empty()) events.print("nothing of this has one correction that is well defined\n");
  for (const compile::Correction& correction : corrections) {
    std::vector<std::string> volumes;
    for (const auto& [name, mm3] : gained_mm3(correction, request))
      volumes.push_back(name + (mm3 < 0 ? " -" : " +") + format_rounded(std::abs(mm3)) + " mm3");
    events.print(correction.text + ": " + join(volumes, ", ") + "\n");
  }
}

void tell_findings(const Events& events, const CheckedPart& part, const voxel::Lattice& lattice) {
  if (events.wants_data()) {
    DataList findings, unchecked;
    for (const PrintFinding& finding : part.findings)
      findings.emplace_back(DataMembers{{"kind", finding.kind},
                                        {"is_error", finding.is_error},
                                        {"text", finding.text},
                                        {"remedy", finding.remedy},
                                        {"places", number(finding.pieces.count)},
                                        {"volume_mm3", volume_mm3(finding.pieces.voxels, lattice)},
                                        {"largest", places_data(finding, lattice)}});
    unchecked.assign(part.unchecked.begin(), part.unchecked.end());
    for (const PrintFinding& finding : part.findings) events.warn(line(finding, lattice) + "; " + finding.remedy);
    return events.event("checked", {{"printer", part.printer},
                                    {"is_printable", std::ranges::none_of(part.findings, &PrintFinding::is_error)},
                                    {"findings", std::move(findings)},
                                    {"unchecked", std::move(unchecked)}});
  }
  std::string text;
  for (const PrintFinding& finding : part.findings)
    text += (finding.is_error ? "error: " : "warning: ") + line(finding, lattice) + "\n  " + finding.remedy + "\n";
  for (const std::string& sentence : part.unchecked) text += "not checked: " + sentence + "\n";
  events.print(text + verdict(part) + "\n");
}

std::string findings_page(const CheckedPart& part, const compile::Plan& plan, const StopFlag* stop) {
  ReportPage page(part.design + " on " + part.printer + ": " + verdict(part));
  for (const PrintFinding& finding : part.findings) {
    page.add_heading((finding.is_error ? "Error: " : "Warning: ") + finding.text);
    std::vector<std::string> lines{line(finding, plan.request.lattice), finding.remedy};
    for (const FlagPiece& piece : finding.pieces.largest)
      lines.push_back(format_rounded(volume_mm3(piece.voxels, plan.request.lattice)) + " mm3 " +
                      extent(piece, plan.request.lattice));
    page.add_list("Places", lines);
    if (finding.flags.height() > 0)
      page.add_picture("layer " + std::to_string(finding.layer), picture(finding, plan, stop));
  }
  page.add_list("Not checked", part.unchecked);
  return page.html();
}

}  // namespace ombre::jobs
