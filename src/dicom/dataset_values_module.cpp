#include "base/text/text.h"
#include "dicom/dataset_values.h"

namespace ombre::dicom {

std::string bytes_of(const gdcm::DataSet& data, const gdcm::Tag& tag) {
  if (!data.FindDataElement(tag)) return "";
  const gdcm::ByteValue* value = data.GetDataElement(tag).GetByteValue();
  return value && value->GetPointer() ? std::string(value->GetPointer(), value->GetLength()) : std::string();
}

std::string text_of(const gdcm::DataSet& data, const gdcm::Tag& tag) {
  std::string text = bytes_of(data, tag);
  while (!text.empty() && text.back() == '\0') text.pop_back();
  return std::string(trim(text));
}

std::vector<double> decimals_of(const gdcm::DataSet& data, const gdcm::Tag& tag) {
  std::vector<double> numbers;
  const std::string text = text_of(data, tag);
  if (text.empty()) return {};
  for (const std::string& word : split(text, '\\')) {
    const auto number = parse_number(trim(word));
    if (!number) return {};
    numbers.push_back(*number);
  }
  return numbers;
}

std::optional<double> decimal_of(const gdcm::DataSet& data, const gdcm::Tag& tag) {
  const std::vector<double> numbers = decimals_of(data, tag);
  return numbers.empty() ? std::nullopt : std::optional(numbers[0]);
}

gdcm::SmartPointer<gdcm::SequenceOfItems> items_of(const gdcm::DataSet& data, const gdcm::Tag& tag) {
  if (!data.FindDataElement(tag)) return nullptr;
  return data.GetDataElement(tag).GetValueAsSQ();
}

const gdcm::DataSet* first_item(const gdcm::DataSet& data, const gdcm::Tag& tag,
                                gdcm::SmartPointer<gdcm::SequenceOfItems>& keeper) {
  keeper = items_of(data, tag);
  return keeper && keeper->GetNumberOfItems() > 0 ? &keeper->GetItem(1).GetNestedDataSet() : nullptr;
}

}  // namespace ombre::dicom
