// SPDX-License-Identifier: BSD-3-Clause
// Does nothing, but loads what the programs load that are run under valgrind.
int main() {}
