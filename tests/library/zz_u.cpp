#include "../../tests/library/library_test.cpp"
#include "../../tests/manual/manual_test.cpp"
#include "../../tests/processes/install_test.cpp"
