#include <memory>

#include "tabor/cli/completion.hpp"
#include "tabor/cli/result.hpp"
#include "tabor/cli/verbs.hpp"
#include "tabor/core/text.hpp"

namespace tabor::cli {

namespace {

struct Shell {
  const char* name;
  std::string (*completion)();
};
constexpr Shell kShells[] = {
    {"bash", bash_completion}, {"zsh", zsh_completion}, {"fish", fish_completion}};

std::vector<std::string> names_of_shells() {
  std::vector<std::string> names;
  for (const Shell& shell : kShells) names.emplace_back(shell.name);
  return names;
}

int show(const std::string& name, Context& context) {
  chosen_word("SHELL", name, names_of_shells());
  for (const Shell& shell : kShells) {
    if (shell.name != name) continue;
    const std::string script = shell.completion();
    io::Json object = json_head(context);
    object["script"] = script;
    return finish(context, object, script);
  }
  return kUsage;
}

}  // namespace

std::string first_clause(const std::string& help) {
  return std::string(trim(std::string_view(help).substr(0, help.find_first_of(";:["))));
}

Verb completion_verb() {
  return {.name = "completion",
          .arguments = "SHELL",
          .summary = "print the script with which a shell completes verbs, options and files",
          .details =
              "Installed packages bring the scripts along. For a program that is not installed: "
              "'source <(tabor completion bash)'. docs/terminal.md has the same for zsh and fish.",
          .examples = {"tabor completion bash", "tabor completion fish"},
          .declare = [](OptionSet& set) -> Action {
            const auto shell = std::make_shared<std::string>();
            set.group("Shell");
            set.positional("SHELL", "bash, zsh or fish", *shell).words = names_of_shells();
            return [shell](Context& context) { return show(*shell, context); };
          }};
}

}  // namespace tabor::cli
