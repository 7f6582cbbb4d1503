// Reads the model files of a 3MF package. Only for builds with pugixml.
#pragma once

#include <set>

#include "formats/containers/xml_file.h"
#include "formats/packages/assembly.h"

namespace ombre::formats {

// Returns the key of an object in an assembly.
std::string object_key(std::string_view part, uint64_t id);
std::string id_of_key(const std::string& key);

// Adds the objects of a model file, which is named `part` in the package, and adds the parts that it refers to to
// `further`.
void add_objects(const XmlFile& file, const std::string& part, Assembly& assembly, std::set<std::string>& further);

// Adds the global settings of a package's main model file: its unit, and the objects to build.
void add_build(const XmlFile& file, const std::string& part, Assembly& assembly, std::set<std::string>& further);

}  // namespace ombre::formats
