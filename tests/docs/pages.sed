# SPDX-License-Identifier: BSD-3-Clause
# What Doxygen sees of a page: it numbers headings, so a link to a heading of another page becomes one to that page.
s/\.md#[a-z0-9-]+\)/.md)/g

# It shows the markup of code in headings.
/^#+ /s/`//g
