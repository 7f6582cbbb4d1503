#include "base/text/code.h"

namespace ombre {
namespace {

constexpr CodeInfo table[] = {
    {Code::design, "design", "The design is wrong in a way that has no code of its own", ""},
    {Code::syntax, "syntax", "A script cannot be parsed at this place", ""},
    {Code::script, "script", "A script cannot be evaluated: a statement or an expression is wrong", ""},
    {Code::assertion, "assertion", "An `assert` of the script does not hold", ""},
    {Code::expression, "expression", "A formula cannot be read", ""},
    {Code::design_file, "design-file", "A design file has no such form, or is no JSON", ""},
    {Code::materials_file, "materials-file", "A file of materials has another form", ""},
    {Code::printer_file, "printer-file", "A printer's profile has another form", ""},
    {Code::study, "study", "A study does not fit the design, or itself", ""},
    {Code::study_value, "study-value", "A member of a study is missing, or has a value that it cannot have", ""},
    {Code::unknown_node, "unknown-node", "There is no node of that name", "node, similar"},
    {Code::unknown_parameter, "unknown-parameter", "A node has no such parameter", "node, parameter, similar"},
    {Code::unknown_material, "unknown-material", "There is no material of that name", "material, similar"},
    {Code::unknown_attribute, "unknown-attribute", "The solid, or the design, has no such attribute", "attribute"},
    {Code::unknown_output, "unknown-output", "A node that gives values has no such output", "node, output"},
    {Code::unknown_part, "unknown-part", "The design has no part of that name", "part"},
    {Code::unknown_object, "unknown-object", "A file has no object, solid, field or material of that name",
     "file, name"},
    {Code::unknown_variable, "unknown-variable", "There is no variable of that name", "name"},
    {Code::unknown_function, "unknown-function", "There is no function of that name", "name"},
    {Code::unknown_printer, "unknown-printer", "There is no printer of that name", "printer"},
    {Code::unknown_key, "unknown-key", "A member of a file's object is not known", "key"},
    {Code::unknown_font, "unknown-font", "There is no font of that name, or it lacks letters", "font"},
    {Code::parameter_missing, "parameter-missing", "A node needs a parameter that is not given", "node, parameter"},
    {Code::parameter_type, "parameter-type", "A parameter takes values of another kind",
     "node, parameter, expected, found"},
    {Code::parameter_range, "parameter-range", "A number or a word is not among those that a parameter takes",
     "node, parameter, expected, found"},
    {Code::parameters, "parameters", "The parameters or the solids of a node do not go together", "node"},
    {Code::inputs, "inputs", "A node takes another number of solids, or solids in place of values", "node"},
    {Code::twice, "twice", "A name is given twice", "name"},
    {Code::limit, "limit", "A limit of designs, scripts, file formats or printers is passed", ""},
    {Code::unbounded, "unbounded", "The design, or a solid that needs bounds, is unbounded along an axis", ""},
    {Code::nothing_inside, "nothing-inside", "Nothing of the design lies in the job's box, or it is empty", ""},
    {Code::outside_box, "outside-box", "The design, or what is asked for, does not lie in the box or on the tray", ""},
    {Code::distance_unknown, "distance-unknown", "A solid gives a sign where a distance in mm is needed", ""},
    {Code::file_missing, "file-missing", "There is no file of that name", "file"},
    {Code::file_kind, "file-kind", "The file is of another kind than this reads or writes", "file"},
    {Code::file_content, "file-content", "The content of a file is damaged, or cannot be used", "file"},
    {Code::surface_open, "surface-open", "A mesh does not enclose space", "file"},
    {Code::surface_crosses, "surface-crosses", "A surface crosses itself, and a solid is to be made of it", "file"},
    {Code::option, "option", "An option of a job has a value that it cannot have, or does not go with another", ""},
    {Code::exists, "exists", "A file or a job is there already and is not replaced", "file"},
    {Code::other_job, "other-job", "A folder holds another job, or another run writes into it", "file"},
    {Code::unfinished, "unfinished", "Shares of a job are missing", "file"},
    {Code::too_large, "too-large", "The job has more voxels, cells or pixels than are possible", ""},
    {Code::memory, "memory", "The job takes more memory than it may", ""},
    {Code::disk_space, "disk-space", "The files take more space than is left", "file"},
    {Code::cannot_read, "cannot-read", "A file or a folder cannot be read", "file"},
    {Code::cannot_write, "cannot-write", "A file cannot be written", "file"},
    {Code::library_missing, "library-missing", "This ombre was built without a library that the job needs", ""},
    {Code::not_solved, "not-solved", "The equations of a simulation have no solution, or none was found", ""},
    {Code::not_meshed, "not-meshed", "A solid cannot be cut into tetrahedra, or not of that size", ""},
    {Code::other_program, "other-program", "Another program is missing, cannot be started or failed", ""},
    {Code::machine, "machine", "The machine failed in a way that has no code of its own", ""},
};

constexpr bool is_in_order() {
  size_t n = 0;
  for (const CodeInfo& info : table)
    if (static_cast<size_t>(info.code) != n++) return false;
  return n == static_cast<size_t>(Code::machine) + 1;
}
static_assert(is_in_order());

}  // namespace

std::span<const CodeInfo> codes() { return table; }

std::string_view name_of(Code code) { return table[static_cast<size_t>(code)].name; }

}  // namespace ombre
