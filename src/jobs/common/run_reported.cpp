#include "jobs/common/run_reported.h"

#include <new>

#include "base/system/tasks.h"
#include "base/text/error.h"
#include "jobs/common/exit_codes.h"
#include "options/option_values.h"

namespace ombre::jobs {

int run_reported(const Events& events, const std::function<int()>& work) {
  try {
    return work();
  } catch (const options::WrongValue& error) {
    events.error(error.code(), error.message());
    return wrong_input;
  } catch (const Cancelled&) {
    return interrupted;
  } catch (const Error& error) {
    events.error(error.code(), error.message(), error.values());
  } catch (const std::bad_alloc&) {
    events.error(Code::memory, "not enough memory; try fewer " + spelled::option("--threads") + ", or a smaller " +
                                   spelled::option("--memory"));
  } catch (const std::exception& error) {
    events.error(Code::machine, std::string(error.what()));
  }
  return failed;
}

}  // namespace ombre::jobs
