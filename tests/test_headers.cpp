// SPDX-License-Identifier: BSD-3-Clause
// Compiled for its precompiled headers; see CMakeLists.txt.
int main() {}
