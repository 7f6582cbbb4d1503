// Warns of extensions in a 3MF model that are not supported.
#ifdef OMBRE_3MF

#include "formats/packages/three_mf_extensions.h"

#include <algorithm>
#include <map>
#include <span>
#include <vector>

#include "base/text/text.h"
#include "formats/containers/text_scanner.h"

namespace ombre::formats {
namespace {

using pugi::xml_node;

// Parts of the names of namespaces that are read, and of those that only contain slicers' settings.
constexpr std::string_view read_spaces[]{"/core/", "/material/", "/production/", "/beamlattice/"};
constexpr std::string_view harmless_spaces[]{"/trianglesets/", "slic3r.org", "bambulab.com", "ultimaker.com"};

// Elements with children, among which extensions insert their own.
constexpr std::string_view holders[]{"resources", "build", "object", "mesh", "beamlattice"};
constexpr std::string_view known_elements[]{"resources",       "build",       "object",         "mesh",
                                            "vertices",        "triangles",   "components",     "item",
                                            "metadata",        "settings",    "metadatagroup",  "basematerials",
                                            "colorgroup",      "texture2d",   "texture2dgroup", "compositematerials",
                                            "multiproperties", "beamlattice", "beams",          "balls",
                                            "beamsets"};

bool is_listed(std::string_view text, std::span<const std::string_view> list) {
  return std::find(list.begin(), list.end(), text) != list.end();
}

bool names_one_of(std::string_view space, std::span<const std::string_view> parts) {
  return std::any_of(parts.begin(), parts.end(),
                     [&](std::string_view part) { return space.find(part) != std::string_view::npos; });
}

bool is_read_space(std::string_view space) { return names_one_of(space, read_spaces); }

std::string prefix_of(xml_node node) {
  const std::string_view name = node.name();
  return std::string(name.substr(0, name.size() - local_name(node).size()));
}

// Returns the namespace of a prefix; empty if it is undefined.
std::string_view space_of(xml_node node, std::string prefix) {
  if (prefix.ends_with(':')) prefix.pop_back();
  const std::string attribute = prefix.empty() ? "xmlns" : "xmlns:" + prefix;
  for (; node; node = node.parent())
    if (const pugi::xml_attribute found = node.attribute(attribute.c_str())) return found.value();
  return {};
}

class ExtensionFinder {
 public:
  explicit ExtensionFinder(const XmlFile& file) : file_(file) {}

  void require(xml_node model, std::string_view prefixes) {
    for (std::string_view prefix = next_word(prefixes); !prefix.empty(); prefix = next_word(prefixes)) {
      const std::string_view space = space_of(model, std::string(prefix));
      if (!is_read_space(space)) extension(std::string(prefix), space);
    }
  }

  void search(xml_node node) {
    for (const xml_node child : node.children()) {
      const std::string_view name = local_name(child);
      const std::string_view space = space_of(child, prefix_of(child));
      if (name.empty() || names_one_of(space, harmless_spaces)) continue;
      const bool is_read = is_listed(name, known_elements) && (space.empty() || is_read_space(space));
      if (!is_read)
        ++extension(prefix_of(child), space).elements[std::string(name)];
      else if (is_listed(name, holders))
        search(child);
    }
  }

  void warn() const {
    for (const auto& [name, extension] : extensions_) file_.diagnostics().warning({}, message(extension));
  }

 private:
  struct Extension {
    std::string prefix, space;
    std::map<std::string, uint64_t> elements;  // number of occurrences by name
  };

  Extension& extension(std::string prefix, std::string_view space) {
    if (prefix.ends_with(':')) prefix.pop_back();
    Extension& found = extensions_[space.empty() ? prefix : std::string(space)];
    if (found.prefix.empty()) found.prefix = prefix;
    found.space = space;
    return found;
  }

  std::string message(const Extension& extension) const {
    constexpr size_t longest_space = 200;
    std::vector<std::string> counts;
    for (const auto& [name, count] : extension.elements) counts.push_back(format_count(count) + " <" + name + '>');
    const std::string elements = join(counts, ", ");
    const bool is_core = extension.prefix.empty() && (extension.space.empty() || is_read_space(extension.space));
    if (is_core) return file_.name() + ": elements of unknown names are not read: " + elements;
    const std::string called =
        extension.prefix.empty() ? "a 3MF extension" : "the 3MF extension " + formats::quoted(extension.prefix);
    return file_.name() + ": what " + called + " adds is not read" +
           (extension.space.empty() ? "" : ": " + formats::quoted(extension.space, longest_space)) +
           (elements.empty() ? "" : " (" + elements + ')');
  }

  const XmlFile& file_;
  std::map<std::string, Extension> extensions_;
};

}  // namespace

void warn_of_extensions(const XmlFile& file, xml_node model) {
  ExtensionFinder finder(file);
  finder.require(model, file.attribute(model, "requiredextensions").value_or(""));
  finder.search(model);
  finder.warn();
}

}  // namespace ombre::formats

#endif
