#include "tabor/cli/exit_code.hpp"

#include <filesystem>
#include <new>

#include "tabor/core/error.hpp"
#include "tabor/io/files/regular_file.hpp"

namespace tabor::cli {

int guarded(const Complaint& complain, const std::function<int()>& body) {
  try {
    return body();
  } catch (const UsageError& error) {
    return complain(error.what(), kUsage);
  } catch (const OutputError& error) {
    return complain(error.what(), kOutput);
  } catch (const Interrupted&) {
    return complain("interrupted", kInterrupted);
  } catch (const Error& error) {
    return complain(error.what(), kInput);
  } catch (const std::bad_alloc&) {
    return complain("not enough memory for a surface of this size; crop or resample it", kInput);
  } catch (const std::filesystem::filesystem_error& error) {
    return complain(error.path1().string() + ": " + io::reading_problem(error.code().value()),
                    kInput);
  } catch (const std::exception& error) {
    return complain(std::string("internal error: ") + error.what(), kInternal);
  }
}

}  // namespace tabor::cli
