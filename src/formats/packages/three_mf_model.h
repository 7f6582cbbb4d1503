// The model files of a 3MF package. Only for files that are built with pugixml.
#pragma once

#include <set>

#include "formats/containers/xml_file.h"
#include "formats/packages/assembly.h"

namespace ombre::formats {

// The key of an object in an assembly.
std::string object_key(std::string_view part, uint64_t id);
std::string id_of_key(const std::string& key);

// Adds the objects of a model file, which is called `part` in the package, and to `further` the parts that it
// refers to.
void add_objects(const XmlFile& file, const std::string& part, Assembly& assembly, std::set<std::string>& further);

// Adds what a package's main model file says of the whole: its unit, and what is built.
void add_build(const XmlFile& file, const std::string& part, Assembly& assembly, std::set<std::string>& further);

}  // namespace ombre::formats
