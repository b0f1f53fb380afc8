#include "tools/program.h"

int main(int argc, char** argv) { return lozenge::run_program(argc, argv); }
