// Values of the elements of a DICOM data set.
#pragma once

#include <gdcmDataSet.h>
#include <gdcmSequenceOfItems.h>

#include <cstring>
#include <optional>
#include <string>
#include <vector>

namespace ombre::dicom {

// Returns the bytes of an element; empty if it is not there. The library gives binary numbers in the machine's order.
std::string bytes_of(const gdcm::DataSet& data, const gdcm::Tag& tag);
// Returns a text without the blanks and zeros that fill it up.
std::string text_of(const gdcm::DataSet& data, const gdcm::Tag& tag);
// Returns the numbers of a text such as "1\0.5"; empty if one is wrong.
std::vector<double> decimals_of(const gdcm::DataSet& data, const gdcm::Tag& tag);
std::optional<double> decimal_of(const gdcm::DataSet& data, const gdcm::Tag& tag);

// Returns the binary number of an element, if there is one.
template <class T>
std::optional<T> binary_of(const gdcm::DataSet& data, const gdcm::Tag& tag) {
  const std::string bytes = bytes_of(data, tag);
  if (bytes.size() < sizeof(T)) return std::nullopt;
  T value;
  std::memcpy(&value, bytes.data(), sizeof value);
  return value;
}

// Returns the items of a sequence, or null.
gdcm::SmartPointer<gdcm::SequenceOfItems> items_of(const gdcm::DataSet& data, const gdcm::Tag& tag);
// Returns the first item of a sequence, or null. The data set must outlive it.
const gdcm::DataSet* first_item(const gdcm::DataSet& data, const gdcm::Tag& tag,
                                gdcm::SmartPointer<gdcm::SequenceOfItems>& keeper);

}  // namespace ombre::dicom
