#pragma once

#include "tabor/cli/verb.hpp"

// Declares one function per verb of the command line; verb.cpp puts them in order.
namespace tabor::cli {

Verb info_verb();
Verb convert_verb();
Verb params_verb();
Verb psd_verb();
Verb combine_verb();
Verb generate_verb();
Verb contact_verb();
Verb lubricate_verb();
Verb friction_verb();
Verb slide_verb();
Verb sweep_verb();
Verb ehl_verb();
Verb report_verb();
Verb view_verb();
Verb table_verb();
Verb formats_verb();
Verb materials_verb();
Verb cite_verb();
Verb options_verb();
Verb completion_verb();
Verb man_verb();

}  // namespace tabor::cli
