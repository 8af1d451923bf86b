#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Makes the pages of the API. Fails where Doxygen warns, and where it leaves markup in a page as it is, of
# which it says nothing: a link whose text goes over two lines does that to all that follows.
#   tests/docs/make_docs.sh DOXYGEN DOXYFILE HTML
set -euo pipefail
doxygen=$1 doxyfile=$2 html=$3

cd "$(dirname "${BASH_SOURCE[0]}")/../.."
rm -rf "$html"
"$doxygen" "$doxyfile"
if grep -lE '@(code|endcode|image|ref)\b|&lt;(tt|b|em)&gt;' "$html"/*.html; then
  echo "error: markup is left in these pages" >&2
  exit 1
fi
