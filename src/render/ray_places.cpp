#include "render/ray_places.h"

namespace ombre::render {

void RayPlaces::fill(const program::Read& read, const eval::RowsToFill& to) const {
  for (size_t n = 0; n < places_.size(); ++n)
    to.values[n] = sources_->inside(read.tag, places_[n].fine, places_[n].column, places_[n].row) ? 1 : 0;
}

void RayPlaces::evaluate(const program::Program& program, const std::vector<Interval>& ranges,
                         std::span<const RayPlace> places, const voxel::StripSources& sources) {
  sources_ = &sources;
  places_ = places;
  depths_.clear();
  rights_.clear();
  downs_.clear();
  for (const RayPlace& place : places) {
    depths_.push_back(static_cast<float>(steps_.depth(place.fine)));
    rights_.push_back(static_cast<float>(steps_.film.right_of(place.column)));
    downs_.push_back(static_cast<float>(steps_.film.down_of(place.row)));
  }
  batch_.compile_for_list(program, ranges, places.size(), *this);
  batch_.place({depths_, rights_, downs_});
  batch_.begin_layer(0);
  batch_.begin_row(0);
  batch_.finish_row();
}

}  // namespace ombre::render
