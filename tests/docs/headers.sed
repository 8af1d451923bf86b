# SPDX-License-Identifier: BSD-3-Clause
# What Doxygen sees of a header. Lines are emptied, not removed, so that its messages name the right ones.

# Doxygen takes explicit instantiations for functions of their own.
/^extern template/,/;/s/.*//

# Copying, moving and default construction without a comment do what their names say.
/^ +(explicit )?(\w+)\((const \2&|\2&&)( \w+)?\)( noexcept)?( = default)?;/s/.*//
/operator=\((const (\w+)&|(\w+)&&)( \w+)?\)/s/.*//
/^ +\w+\(\) = default;/s/.*//

# `m. Lower bound ...`: the summary is the first sentence, not the unit.
s/^( *\/\/\/) (m|rad|s|m\^2|Probability)\. /\1 (\2) /
