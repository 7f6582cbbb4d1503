// Messages of builds without libzip and pugixml (OMBRE_3MF=OFF).
#pragma once

namespace ombre::formats {

inline constexpr const char* xml_missing = "this ombre was built without libzip and pugixml";
inline constexpr const char* xml_remedy =
    "install libzip-dev and libpugixml-dev, configure with -DOMBRE_3MF=ON and build again";

}  // namespace ombre::formats
