# SPDX-License-Identifier: BSD-3-Clause
# Help of the program, or of a subcommand, as a part of its manual page, in macros of man(7):
#   name      NAME, of the first line
#   synopsis  how it is typed
#   options   its options alone
#   notes     what is below them
#   command   all of it under a heading
function plain(text) {
  gsub(/\\/, "\\e", text)
  gsub(/-/, "\\-", text)
  gsub(/'/, "\\(aq", text)
  gsub(/`/, "\\(ga", text)
  gsub(/\^/, "\\(ha", text)
  gsub(/~/, "\\(ti", text)
  return (text ~ /^\./ ? "\\\&" : "") text
}

# `-o,--output FILE`, `--set NAME Needs: --problems` and `--group NAME Excludes: --joints --chain`: what is typed as it is
# in bold.
function term(text,    words, count, i, out, tail) {
  count = split(text, words, " ")
  for (i = 1; i <= count; ++i) {
    if (words[i] == "REQUIRED") tail = tail " (required)"
    else if (words[i] == "Needs:") tail = tail " (with \\fB" plain(words[++i]) "\\fR)"
    else if (words[i] == "Excludes:") {
      tail = tail " (without \\fB" plain(words[++i]) "\\fR"
      while (i < count) tail = tail " and \\fB" plain(words[++i]) "\\fR"
      tail = tail ")"
    } else if (words[i] ~ /^-/) {
      words[i] = plain(words[i])
      gsub(/,/, "\\fR, \\fB", words[i])
      out = out " \\fB" words[i] "\\fR"
    } else if (words[i] == "...") out = out " ..."
    else out = out " \\fI" plain(words[i]) "\\fR"
  }
  return substr(out tail, 2)
}

# `swept plan [OPTIONS] robot [states...]`: the words of the command in bold.
function usage(text,    count) {
  sub(/^Usage: /, "", text)
  count = index(text, " [OPTIONS]")
  return "\\fB" plain(substr(text, 1, count - 1)) "\\fR" plain(substr(text, count))
}

# Names are in the first 30 columns, or alone on their line where they do not fit.
function describe(first, last,    i, name, text) {
  for (i = first; i <= last; ++i) {
    if (line[i] !~ /^  [^ ]/) continue
    name = substr(line[i], 1, 30)
    text = substr(line[i], 31)
    if (i < last && substr(line[i + 1], 1, 30) ~ /^ +$/) {
      name = line[i]
      text = substr(line[++i], 31)
    }
    print ".TP"
    print term(name)
    print plain(text)
  }
}

# Paragraphs; what is set in from the left stays in its lines.
function notes(first, last,    i, begun, between, set_in) {
  for (i = first; i <= last; ++i) {
    if (line[i] == "") { between = begun; continue }
    begun = 1
    if (set_in != (line[i] ~ /^  /)) {
      set_in = !set_in
      print set_in ? (between ? ".PP\n" : "") ".RS 2\n.nf" : ".fi\n.RE"
    }
    if (between && !set_in) print ".PP"
    between = 0
    print plain(set_in ? substr(line[i], 3) : line[i])
  }
  if (set_in) print ".fi\n.RE"
}

{ line[NR] = $0 }
/^Positionals:$/ { positionals = NR }
/^Options:$/ { options = NR }
/^Subcommands:$/ { listed = NR }
/^$/ && options && !options_end { options_end = NR }
/^$/ && (listed || options) { if (!below || below < listed) below = NR }

END {
  if (!options || !below || line[2] !~ /^Usage: swept.* \[OPTIONS\]/) {
    print "manual.awk: this is no help of the program: " line[1] > "/dev/stderr"
    exit 1
  }
  if (part == "name") {
    sub(/\.$/, "", line[1])
    print ".SH NAME"
    print "swept \\- " tolower(substr(line[1], 1, 1)) plain(substr(line[1], 2))
  } else if (part == "synopsis") {
    print usage(line[2])
  } else if (part == "options") {
    describe(options + 1, options_end - 1)
  } else if (part == "notes") {
    notes(below + 1, NR)
  } else if (part == "command") {
    print ".SS " plain(substr(line[2], 8, index(line[2], " [OPTIONS]") - 8))
    print plain(line[1]) (line[1] ~ /[.?]$/ ? "" : ".")
    print ".PP"
    print usage(line[2])
    if (positionals) describe(positionals + 1, options - 2)
    describe(options + 1, options_end - 1)
    print ".PP"
    notes(below + 1, NR)
  }
}
