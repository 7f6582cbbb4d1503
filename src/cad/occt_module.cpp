// CAD files by Open CASCADE: the module.
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_Printer.hxx>

#include <mutex>

#include "cad/module.h"
#include "cad/occt_crash.h"
#include "cad/occt_guard.h"
#include "cad/occt_shapes.h"

void ombre_read_cad(const std::string* path, std::vector<ombre::cad::SolidPtr>* solids) {
  // The library's readers share settings.
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  // It would tell of its progress on the console.
  Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_Printer));
  const std::string what = "cannot read " + *path;
  const auto read = [&] {
    for (const ombre::cad::NamedShape& shape : ombre::cad::read_shapes(*path))
      solids->push_back(ombre::cad::make_solid(shape));
  };
  if (!ombre::cad::survives([&] { ombre::cad::guarded(what, read); }))
    throw ombre::Error(what + ": it is broken; export it again, as STEP AP214 or AP242");
}
