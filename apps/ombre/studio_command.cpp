// `ombre studio` opens the page in the browser.
#include <unistd.h>

#include <filesystem>
#include <memory>
#include <optional>

#include "base/system/environment.h"
#include "base/text/error.h"
#include "formats/containers/file.h"
#include "load/bundle.h"
#include "ombre/checks.h"
#include "ombre/command_line.h"
#include "ombre/commands.h"
#ifdef OMBRE_WITH_STUDIO
#include "base/system/not_copied.h"
#include "studio/page.h"
#include "studio/server.h"
#include "studio/workspace/child_process.h"
#include "studio/workspace/state_folder.h"
#endif

namespace ombre::cli {
namespace {

struct StudioArguments {
  std::string place = ".";
  int port = 0;
  double idle = 0;
  bool no_browser = false;
};

constexpr const char* studio_footer =
    "The page is served to this machine alone, at an address with a token. From another machine, the printed\n"
    "line makes a tunnel. Ctrl-C ends it; jobs go on from where they stopped.\n\n"
    "Examples:\n"
    "  ombre studio                   the designs in this folder\n"
    "  ombre studio part.vcad         one of them\n"
    "  ombre studio part.ombre        a bundle, unpacked into the folder part beside it\n"
    "  ombre studio --port 8899 --no-browser\n";

#ifdef OMBRE_WITH_STUDIO

// Returns the token that the environment sets, so that a page finds a restarted server again; empty for a random one.
// Throws options::WrongValue.
std::string chosen_token() {
  std::string token = environment("OMBRE_STUDIO_TOKEN");
  constexpr size_t shortest = 32;
  if (!token.empty() && (token.size() < shortest || token.find_first_not_of("0123456789abcdefABCDEF") != token.npos))
    throw options::WrongValue(
        "OMBRE_STUDIO_TOKEN is not at least 32 hexadecimal digits; leave it out for a random one");
  return token;
}

bool has_display() { return !environment("DISPLAY").empty() || !environment("WAYLAND_DISPLAY").empty(); }

// Returns the words that start this command line again, through Python if that runs it.
std::vector<std::string> own_command() {
  std::error_code ignored;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", ignored);
  if (program.empty()) return {};
  if (program.filename() == "ombre") return {program.string()};
  return {program.string(), "-m", "ombre"};
}

// A file that leads the browser to the page. The address has the token, which other users of this machine would see in
// the arguments of a program; only this user can read the file.
class Signpost : NotCopied {
 public:
  explicit Signpost(const std::string& url) {
    const std::string runtime = environment("XDG_RUNTIME_DIR");
    path_ = (runtime.empty() ? std::filesystem::temp_directory_path().string() : runtime) + "/ombre-studio-XXXXXX.html";
    constexpr int ending = 5;
    const int file = ::mkstemps(path_.data(), ending);
    if (file < 0)
      throw Error(
          Code::cannot_write,
          "cannot write " + path_ + ", by which the browser finds the studio; write " + spelled::option("--no-browser"),
          {{"file", path_}});
    const std::string text = "<!doctype html><meta http-equiv=\"refresh\" content=\"0; url=" + url + "\">\n";
    [[maybe_unused]] const ssize_t written = ::write(file, text.data(), text.size());
    ::close(file);
  }
  ~Signpost() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

void tell_address(const studio::Address& address, const Console& console) {
  const std::string port = std::to_string(address.port);
  console.say("The studio is at\n\n    " + address.url() +
              "\n\nand ends with Ctrl-C. From another machine:\n\n    ssh -L " + port + ":127.0.0.1:" + port +
              " USER@THIS_MACHINE\n");
  if (address.wanted_port != 0 && address.port != address.wanted_port)
    console.say("Port " + std::to_string(address.wanted_port) +
                ", which belongs to this folder, is taken; drafts and jobs come back at this one too.\n");
  console.event("studio", {{"url", address.url()}, {"port", static_cast<double>(address.port)}});
}

// Unpacks a bundle into the folder beside it with its name, and returns its design. If an earlier call has unpacked it,
// that folder is used, with all changes made since. Throws options::WrongValue and Error.
std::filesystem::path opened_bundle(const std::filesystem::path& bundle, const Console& console) {
  const std::filesystem::path folder = std::filesystem::path(bundle).replace_extension();
  if (const auto known = compile::find_unpacked(folder)) {
    console.say("The bundle was unpacked into " + folder.string() + " before; what is there is shown.\n");
    return known->design;
  }
  if (std::filesystem::exists(folder))
    throw options::WrongValue(folder.string() + " is there, and is not this bundle unpacked; rename it, or the bundle");
  Diagnostics diagnostics;
  const auto unpacked =
      compile::unpack_bundle(bundle.string(), formats::read_file(bundle.string()), folder, diagnostics);
  console.diagnose(diagnostics);
  if (!unpacked) {
    std::error_code ignored;
    std::filesystem::remove_all(folder, ignored);
    throw options::WrongValue(bundle.string() + " cannot be opened");
  }
  return unpacked->design;
}

int run_studio(const StudioArguments& a, CommandSession& session) {
  namespace fs = std::filesystem;
  std::error_code error;
  fs::path place = fs::weakly_canonical(a.place, error);
  studio::StudioOptions options;
  options.program = "ombre " OMBRE_VERSION;
  options.command = own_command();
  if (has_display())
    options.open_folder = [](const std::string& shown) { return studio::start_program({"xdg-open", shown}); };
  fs::path folder = place;
  if (!fs::is_directory(place)) {
    if (!fs::exists(place)) throw options::WrongValue(a.place + " is neither a folder nor a file");
    folder = place.parent_path();
    if (compile::is_bundle(a.place)) {
      folder = fs::path(place).replace_extension();
      place = opened_bundle(place, session.console);
    }
    options.first_file = place.lexically_relative(folder).generic_string();
  }
  options.state = studio::state_folder(folder);
  studio::Studio studio(folder, options, session.cache);
  studio::ServerOptions server;
  server.usual_port = studio::usual_port(folder);
  server.port = static_cast<uint16_t>(a.port);
  server.token = chosen_token();
  server.idle_seconds = a.idle;
  server.assets = studio::page_assets();
  std::optional<Signpost> signpost;
  studio::serve(studio, server, session.stop, [&](const studio::Address& address) {
    tell_address(address, session.console);
    if (a.no_browser || session.console.voice() != Voice::people || !has_display()) return;
    signpost.emplace(address.url());
    studio::start_program({"xdg-open", signpost->path()});  // the address is printed anyway if this fails
  });
  return jobs::done;
}

#else

int run_studio(const StudioArguments&, CommandSession&) {
  throw Error(Code::library_missing,
              "this ombre was built without the studio; install nodejs and npm (apt), and build it again");
}

#endif

}  // namespace

Command add_studio(CLI::App& program, OutputOptions& output) {
  CLI::App* app = program.add_subcommand("studio", "Write, see, measure and slice designs in the browser");
  auto arguments = std::make_shared<StudioArguments>();
  app->add_option("place", arguments->place, "A folder of designs, or one design in it (default: this folder)")
      ->type_name("PLACE");
  app->add_option("--port", arguments->port,
                  "Port of 127.0.0.1 (default: one that belongs to the folder, or a free one after it)")
      ->check(whole_between(0, 65535))
      ->type_name("N");
  app->add_option("--idle", arguments->idle, "End after this many seconds without a page or a job (default: never)")
      ->check(between(0.1, 1e9))
      ->type_name("S");
  app->add_flag("--no-browser", arguments->no_browser, "Print the address, and open no browser");
  add_output_options(*app, output);
  app->footer(studio_footer);
  return {app, [arguments](CommandSession& session) { return run_studio(*arguments, session); }};
}

}  // namespace ombre::cli
