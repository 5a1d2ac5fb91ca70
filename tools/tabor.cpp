// The command line program; everything it does is in src/tabor/cli.
#include "tabor/cli/app.hpp"

int main(int argc, char** argv) { return tabor::cli::run(argc, argv); }
