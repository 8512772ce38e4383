#include "apps/cli/command_line.hpp"

int main(int argc, char** argv) { return touchdown::cli::run_program(argc, argv); }
