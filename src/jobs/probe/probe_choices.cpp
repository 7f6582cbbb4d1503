#include "jobs/probe/probe_choices.h"

namespace ombre::compile {

Vec3 parse_point(const std::string& text, const std::string& name) {
  const std::vector<double> values = options::parse_numbers(text);
  if (values.size() == 3) return {values[0], values[1], values[2]};
  throw options::WrongValue("\"" + text + "\" is not a point; write " + spelled::option(name, "x,y,z") +
                            " in mm, for example " + spelled::option(name, "0,0,2.5"));
}

}  // namespace ombre::compile
