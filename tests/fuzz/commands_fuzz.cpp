// `reference`, `cost`, `run --error` and `audit` of a file of any bytes, in the program's own words. Each ends with a
// result of finite numbers or with a typed error of one line, and soon after it is asked to end.

#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <mutex>
#include <new>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <stop_token>
#include <thread>

#include "cli/commands.hpp"
#include "cli/signals.hpp"
#include "hbvm/error.hpp"
#include "reference/taylor_method.hpp"
#include "write_file.hpp"

namespace hbvm::core {
namespace {

using Words = std::vector<std::string>;

[[noreturn]] void fail(const std::string& what, const Words& words) {
  std::cerr << what << "\nhbvm";
  for (const std::string& word : words) std::cerr << ' ' << word;
  std::cerr << std::endl;
  std::abort();
}

/// Asks what runs to end after a while, as a signal would; that it does not is seen by the fuzzer's own limit.
class Watchdog {
 public:
  explicit Watchdog(std::chrono::milliseconds patience)
      : waiting_([this, patience](const std::stop_token& done) {
          std::unique_lock lock(mutex_);
          if (!ended_.wait_for(lock, done, patience, [&] { return done.stop_requested(); })) end_runs(SIGTERM);
        }) {}
  ~Watchdog() {
    waiting_.request_stop();
    waiting_.join();
    end_runs(0);
  }
  Watchdog(const Watchdog&) = delete;

 private:
  std::mutex mutex_;
  std::condition_variable_any ended_;
  std::jthread waiting_;
};

/// What is written to std::cout while this lives.
class Output {
 public:
  Output() : before_(std::cout.rdbuf(text_.rdbuf())) {}
  ~Output() { std::cout.rdbuf(before_); }
  Output(const Output&) = delete;
  std::string text() const { return text_.str(); }

 private:
  std::ostringstream text_;
  std::streambuf* before_;
};

/// The files that the commands read. They are gone with the process.
class Files {
 public:
  const std::string text = name("toml"), claims = name("claims.toml");

  Files() = default;
  ~Files() {
    std::error_code ignored;
    for (const std::string& file : {text, claims}) std::filesystem::remove(file, ignored);
  }
  Files(const Files&) = delete;

 private:
  static std::string name(const std::string& ending) {
    return std::filesystem::temp_directory_path() / ("commands_fuzz." + std::to_string(getpid()) + "." + ending);
  }
};

/// A command that the text itself decides on, so that it is the same every time.
class Choice {
 public:
  explicit Choice(const std::string& text) {
    std::seed_seq seed(text.begin(), text.end());
    random_.seed(seed);
  }

  Words command(const std::string& text, const Files& files) {
    const bool is_tableau = text.find("\nA = ") != std::string::npos || text.starts_with("A = ");
    if (text.find("[[claim]]") != std::string::npos) return audit("--claims", files.text);
    if (is_tableau) return audit("--method", files.text);
    const std::string until = one_of({"1e-3", "1/8", "1", "2*pi", "10", "1e5"});
    switch (random_() % 16) {
      case 0:
        return claim_on(files);
      case 1:
      case 2:
        return {"cost",       files.text,
                "--digits",   one_of({"2", "4", "8", "20"}),
                "--until",    until,
                "--quantity", one_of({"q", "all"}),
                "--methods",  one_of({"rattle", "gauss", "hbvm:3,2", "taylor", "rkf78"})};
      case 3:
      case 4:
      case 5:
      case 6:
      case 7:
      case 8:
        return reference(files, until);
      default:
        return run(files, until);
    }
  }

  /// How long the command may run before it is asked to end. It is mostly short: more files are read in an hour, and
  /// the request comes while a scene is read, checked or bounded as well.
  std::chrono::milliseconds patience() { return std::chrono::milliseconds(random_() % 16 == 0 ? 500 : random_() % 40); }

 private:
  std::string one_of(std::initializer_list<const char*> values) { return values.begin()[random_() % values.size()]; }

  Words reference(const Files& files, const std::string& until) {
    Words words{"reference", files.text, "--digits", one_of({"1", "5", "10", "20", "60"})};
    if (random_() % 4 == 0)
      words.insert(words.end(), {"--at", "0," + until + ",2*" + until});
    else
      words.insert(words.end(), {"--until", until});
    if (random_() % 4 == 0) words.insert(words.end(), {"--route", one_of({"taylor", "hbvm", "closed_form"})});
    return words;
  }

  Words run(const Files& files, const std::string& until) {
    Words words{
        "run",
        files.text,
        "--error",
        "--until",
        until,
        "--step",
        "(" + until + ")/" + one_of({"1", "4", "10"}),
        "--method",
        one_of({"rattle", "hbvm:1,1", "hbvm:3,2", "hbvm:auto,2", "hbvm:8,4", "projected_hbvm:2,1", "restored_hbvm:2,1",
                "energy_momentum", "lobatto:3", "compose:rattle,4", "rkf78", "bulirsch_stoer:8", "taylor"}),
        "--precision",
        one_of({"double", "double", "quad", "mpfr:30"}),
        "--solver",
        one_of({"auto", "auto", "newton", "fixed-point"}),
        "--on-failure",
        one_of({"stop", "halve"})};
    for (const char* const flag : {"--shadow", "--reverse", "--strict"})
      if (random_() % 4 == 0) words.emplace_back(flag);
    return words;
  }

  Words claim_on(const Files& files) {
    const std::string quantity = one_of({"q", "p", "H", "g", "hidden", "angular momentum", "lambda", "reversal"});
    write_file(files.claims, "[[claim]]\nquantity = \"" + quantity + "\"\nproblem = \"" + files.text +
                                 "\"\nmethod = \"" + one_of({"hbvm:1,1", "hbvm:3,2", "rattle"}) + "\"\nrate = 2\n");
    return audit("--claims", files.claims);
  }

  Words audit(const std::string& option, const std::string& file) {
    Words words{"audit", option, file, "--limit", "0.05", "--jobs", "1"};
    if (random_() % 4 == 0) words.insert(words.end(), {"--until", one_of({"1/4", "3"})});
    return words;
  }

  std::mt19937_64 random_;
};

void require_finite(const nlohmann::json& j, const Words& words) {
  constexpr std::array no_number{"nan", "-nan", "inf", "-inf", "Infinity", "NaN", "@NaN@", "@Inf@", "-@Inf@"};
  for (const nlohmann::json& part : j) {
    if (part.is_structured())
      require_finite(part, words);
    else if (part.is_string() && std::count(no_number.begin(), no_number.end(), part.get<std::string>()) > 0)
      fail("a number that is none in " + j.dump(), words);
  }
}

void carry_out(Words words, std::chrono::milliseconds patience) {
  words.emplace_back("--json");
  CLI::App app;
  add_run_command(app);
  add_audit_command(app);
  add_reference_command(app);
  add_cost_command(app);
  const Output output;
  std::string refusal;
  try {
    const Watchdog watchdog(patience);
    app.parse(Words(words.rbegin(), words.rend()));
  } catch (const CLI::RuntimeError&) {  // a check that did not hold, in the result
  } catch (const Error& error) {
    refusal = error.what();
  } catch (const std::exception& error) {
    fail(std::string("an error without a type: ") + error.what(), words);
  }
  if (refusal.find_first_of("\n\r") != std::string::npos) fail("a message of several lines: " + refusal, words);
  if (!refusal.empty()) return;
  const nlohmann::json result = nlohmann::json::parse(output.text(), nullptr, false);
  if (result.is_discarded()) fail("neither a result nor an error:\n" + output.text(), words);
  require_finite(result, words);
}

}  // namespace
}  // namespace hbvm::core

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const bool ready = (hbvm::core::add_taylor_method(), true);
  static const hbvm::core::Files files;
  const std::string text(reinterpret_cast<const char*>(data), size);
  hbvm::core::write_file(files.text, text);
  hbvm::core::Choice choice(text);
  const auto words = choice.command(text, files);
  hbvm::core::carry_out(words, choice.patience());
  return ready ? 0 : -1;
}
