#include "tabor/cli/exit_code.hpp"

#include <algorithm>
#include <filesystem>
#include <new>
#include <ostream>
#include <string>

#include "tabor/core/error.hpp"
#include "tabor/core/printable.hpp"

namespace tabor::cli {

namespace {

int complain(std::ostream& err, const std::string& message, int code) {
  std::string line = message;
  std::replace(line.begin(), line.end(), '\n', ' ');
  err << "tabor: " << printable(line) << '\n';
  return code;
}

}  // namespace

int guarded(std::ostream& err, const std::function<int()>& body) {
  try {
    return body();
  } catch (const UsageError& error) {
    return complain(err, error.what(), kUsage);
  } catch (const OutputError& error) {
    return complain(err, error.what(), kOutput);
  } catch (const Interrupted&) {
    return complain(err, "interrupted", kInterrupted);
  } catch (const Error& error) {
    return complain(err, error.what(), kInput);
  } catch (const std::bad_alloc&) {
    return complain(err, "not enough memory for a surface of this size; crop or resample it",
                    kInput);
  } catch (const std::filesystem::filesystem_error& error) {
    return complain(err, error.what(), kInput);
  } catch (const std::exception& error) {
    return complain(err, std::string("internal error: ") + error.what(), kInternal);
  }
}

}  // namespace tabor::cli
