#include "questions/attribute_survey.h"

#include "questions/build.h"
#include "questions/design_stages.h"
#include "questions/question.h"
#include "questions/region_survey.h"

namespace ombre::compile {

std::optional<std::vector<SurveyedAttribute>> survey_attributes(const design::Design& of, Diagnostics& diagnostics) {
  StageLoan loan;
  const design::Design design = with_stages(of, loan);
  const size_t errors = diagnostics.error_count();
  std::vector<SurveyedAttribute> surveyed;
  const std::vector<design::AttributeDeclaration> declared = declared_attributes(design);
  const auto box = declared.empty() ? std::optional(Box()) : design_box(design, diagnostics);
  if (!box) return std::nullopt;
  for (const design::AttributeDeclaration& declaration : declared) {
    surveyed.push_back({declaration, {}});
    for (const std::string& part : design::parts_of(declaration))
      surveyed.back().ranges.emplace_back(part, value_range(design, *box, part, diagnostics));
  }
  return diagnostics.error_count() == errors ? std::optional(std::move(surveyed)) : std::nullopt;
}

}  // namespace ombre::compile
