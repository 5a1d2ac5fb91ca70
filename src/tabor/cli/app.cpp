#include "tabor/cli/app.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <ostream>

#include "tabor/cli/defaults.hpp"
#include "tabor/cli/exit_code.hpp"
#include "tabor/cli/explain.hpp"
#include "tabor/cli/failure.hpp"
#include "tabor/cli/help.hpp"
#include "tabor/cli/interrupt.hpp"
#include "tabor/cli/verb.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/parallel.hpp"
#include "tabor/core/printable.hpp"
#include "tabor/core/version.hpp"
#include "tabor/core/watch.hpp"
#include "tabor/io/files/protection.hpp"

namespace tabor::cli {

namespace {

using Words = std::vector<std::string>;

bool has_either(const Words& words, const std::string& flag, const std::string& short_flag) {
  return std::any_of(words.begin(), words.end(),
                     [&](const std::string& word) { return word == flag || word == short_flag; });
}

bool asks_for_help(const Words& words) { return has_either(words, kHelp, kHelpShort); }
bool asks_for_version(const Words& words) { return has_either(words, kVersionFlag, kVersionShort); }

// The words as a shell would need them, so that a result file's command can be pasted.
std::string quoted(const Words& words) {
  std::string line = "tabor";
  for (const std::string& word : words) {
    const bool plain =
        !word.empty() && word.find_first_of(" \t\n'\"\\$&;()<>|*?`#~") == Words::value_type::npos;
    line += plain ? " " + word : " '" + word + "'";
  }
  return line;
}

std::string version_line() { return fmt::format("tabor {}\n", kVersion); }

void check_written(std::ostream& out) {
  out.flush();
  if (!out) throw OutputError("standard output: cannot be written (is the disk full?)");
}

/// The words of a command with the defaults before them.
Words with_defaults(const Verb& verb, const Words& typed, Context& context) {
  Defaults defaults = defaults_for(verb, typed);
  if (defaults.used.empty()) return typed;
  Words words = defaults.words();
  words.insert(words.end(), typed.begin(), typed.end());
  context.defaults_file = std::move(defaults.file);
  context.defaults = std::move(defaults.used);
  Words line = {verb.name};
  line.insert(line.end(), words.begin(), words.end());
  context.command_line = quoted(line);
  context.files.reads(context.defaults_file);
  return words;
}

/// A file cannot ask that nothing be said of it.
void say_defaults(const Context& context) {
  const bool asks_for_quiet = context.quiet && !context.has_default("--quiet");
  if (context.defaults.empty() || context.json || asks_for_quiet) return;
  const Defaults used{context.defaults_file, context.defaults};
  context.err << fmt::format("defaults of {}: {}\n", printable(used.file), used.text());
}

int run_verb(const Verb& verb, const Words& typed, Context& context, ProgressStyle style) {
  const Words words = with_defaults(verb, typed, context);
  OptionSet set;
  const Action action = verb.declare(set);
  declare_common(set, context);
  NamedFiles named;
  parse(noting_files(set, named), verb.name, words);
  check_files(named, context.files);
  say_defaults(context);
  context.spelling = spelling_of(set);
  set_thread_count(static_cast<int>(std::min<std::uint64_t>(context.threads, 4096)));
  ProgressPrinter progress(context.err, context.quiet ? ProgressStyle::none : style);
  context.progress = &progress;
  const Observer observer = context.observer();
  const Watch watch(observer, "");  // everything that runs in loops ends with Ctrl-C
  const int code = action(context);
  check_written(context.out);
  return code;
}

int dispatch(const Words& args, Context& context, ProgressStyle style) {
  if (args.empty()) {
    context.out << greeting();
    check_written(context.out);
    return kDone;
  }
  const Words words(args.begin() + 1, args.end());
  // The version and an explanation may be asked for alone, and behind a verb that exists.
  // NOLINTNEXTLINE(bugprone-branch-clone)
  if (asks_for_version({args.front()})) {
    context.out << version_line();
  } else if (asks_to_explain({args.front()})) {
    return explain(args, context);
  } else if (asks_for_help({args.front()}) || (args.front() == "help" && words.empty())) {
    context.out << overview();
  } else if (args.front() == "help") {
    context.out << help_of(find_verb(words.front()), words.size() > 1 ? words[1] : "");
  } else if (const Verb& verb = find_verb(args.front()); asks_for_help(words)) {
    context.out << help_of(verb, words.front());
  } else if (asks_for_version(words)) {
    context.out << version_line();
  } else if (asks_to_explain(words)) {
    return explain(words, context);
  } else {
    return run_verb(verb, words, context, style);
  }
  check_written(context.out);
  return kDone;
}

// libgomp reads OMP_WAIT_POLICY before main(); spinning idle threads slow everything else down, so
// the program starts itself once more with the policy set. A failure only costs that comfort.
void let_idle_threads_sleep(char** argv) {
  if (std::getenv("OMP_WAIT_POLICY") != nullptr) return;
  setenv("OMP_WAIT_POLICY", "passive", 1);
  std::error_code error;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", error);
  if (!error) execv(self.c_str(), argv);
}

}  // namespace

int run(const std::vector<std::string>& args, std::ostream& out, std::ostream& err,
        ProgressStyle style) {
  Context context{.out = out, .err = err, .command_line = quoted(args)};
  context.json = asks_for_json(args);  // an error is told as JSON even before options are read
  const auto complain = [&](const std::string& line, int code) {
    context.progress = nullptr;  // it ended with the verb
    return fail(context, context.spelled(line), code);
  };
  return guarded(complain, [&] { return dispatch(args, context, style); });
}

int run(int argc, char** argv) {
  let_idle_threads_sleep(argv);
  catch_interrupts();
  let_writing_fail();
  io::isolate_hdf5_reading(true);
  io::trap_lost_pages(true);
  return run(Words(argv + 1, argv + argc), std::cout, std::cerr, progress_style_of_stderr(false));
}

}  // namespace tabor::cli
