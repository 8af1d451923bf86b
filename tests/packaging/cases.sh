# SPDX-License-Identifier: BSD-3-Clause
# Sourced by run.sh: one function a case.

# Everything is there, and names no folder of the build.
case_files() {
  local file component
  for file in share/doc/swept/LICENSE share/doc/swept/README.md include/swept/core/arithmetic.hpp; do
    [[ -f "$prefix/$file" ]] || fail "$file is not installed"
  done
  for component in "${installed[@]}"; do
    # What is not installed is for sources of swept alone.
    diff -r -x simd_dispatch.hpp "$(sources_of "$component")/include/swept/$component" "$prefix/include/swept/$component" ||
      fail "the headers of $component are not those of the tree"
    [[ -f "$library_folder/pkgconfig/swept-${component//_/-}.pc" ]] || fail "no .pc file of $component"
  done
  if [[ -f "$build/planners_demo/swept" ]]; then [[ -x "$prefix/bin/swept" ]] || fail "no program"; fi
  if [[ -f "$build/planners_demo/swept-mpi" ]]; then [[ -x "$prefix/bin/swept-mpi" ]] || fail "no MPI program"; fi
  if grep -rlF '<hwy/' "$prefix/include"; then fail "these headers need Highway"; fi
  if grep -rlF -e "$root" -e "$build" -e "$temporary" "$prefix"; then
    fail "these files name a folder of the sources, of the build, or where they were first installed"
  fi
  links_lead_somewhere
}

sources_of() {
  case "$1" in
    proofs | pages) echo "$root/robot_model/$1" ;;
    *) echo "$root/$1" ;;
  esac
}

# Links of the installed pages, but those to other sites and within a page; words in brackets behind links of code are none.
links_lead_somewhere() {
  local page link count=0
  while IFS= read -r page; do
    while IFS= read -r link; do
      [[ -e "$(dirname "$page")/$link" ]] || fail "$page has a link to $link, which is not installed"
      count=$((count + 1))
    done < <(sed '/^```/,/^```/d' "$page" | grep -oE '\]\([-A-Za-z0-9_./]+[)#]' | sed -E 's/^..(.*).$/\1/')
  done < <(find "$prefix/share/doc/swept" -name '*.md')
  ((count > 50)) || fail "only $count links"
}

# No package is there but those that the core is made for.
case_core() {
  local package hidden=()
  for package in hwy ompl urdfdom urdfdom_headers console_bridge assimp yaml-cpp tinyxml2 TBB nlohmann_json \
    CLI11 fcl octomap OpenSSL ZLIB MPI Boost GTest; do
    hidden+=(-D "CMAKE_DISABLE_FIND_PACKAGE_$package=ON")
  done
  # A program with a flag of its own against what the proofs assume; swept's comes after it.
  configure core "${hidden[@]}" -D CMAKE_CXX_FLAGS="$flags -ffp-contract=fast"
  cmake --build "$temporary/core"
  "$temporary/core/distance" || fail "the core's answers are wrong"

  local contract needed
  contract="$(grep -o -e '-ffp-contract=[a-z]*' "$temporary/core/compile_commands.json" | tail -n 1)"
  [[ "$contract" == -ffp-contract=off ]] || fail "the program is compiled with '$contract'"
  needed="$(readelf -d "$temporary/core/distance" | sed -n 's/.*NEEDED.*\[\(.*\)\]/\1/p')"
  if grep -vE '^(libswept_core|libccd|libstdc\+\+|libm|libgcc_s|libc|libpthread|lib[a-z]+san|ld-linux.*)\.so' \
    <<<"$needed"; then
    fail "the program needs these libraries besides"
  fi
}

case_requests() {
  local names
  printf -v names '%s;' "${installed[@]}"
  configure requests -D INSTALLED="${names%;}" -D IS_STATIC="$is_static"
  # As if the core alone were installed.
  cp -r "$prefix" "$temporary/core_only"
  find "$temporary/core_only" -name 'swept_robot_model*.cmake' -delete -o -name 'swept_proofs*.cmake' -delete -o -name 'swept_pages*.cmake' -delete -o -name 'swept_ompl*.cmake' -delete
  rm -r "$temporary/requests"
  prefix="$temporary/core_only" configure requests -D INSTALLED=core -D IS_STATIC="$is_static"
}

case_full() {
  if ! has ompl_bridge; then
    echo "full: left out (ompl_bridge is not installed)"
    return
  fi
  configure full
  cmake --build "$temporary/full"
  "$temporary/full/motion" "$root/models/robots/rook7/rook7.urdf" "$root/models/scenes/narrow_slot.yaml" ||
    fail "the certificates are wrong"
}

# Certificates and proofs where there is no OMPL.
case_proofs() {
  if ! has proofs; then
    echo "proofs: left out (it is not installed)"
    return
  fi
  configure proofs -D CMAKE_DISABLE_FIND_PACKAGE_ompl=ON -D EXAMPLE="$root/planners_demo/examples/13_certify_path.cpp"
  cmake --build "$temporary/proofs"
  "$temporary/proofs/certify_path" "$root/models" || fail "the proof is wrong"
  if ldd "$temporary/proofs/certify_path" | grep -E 'libompl|libboost'; then fail "the program needs these libraries"; fi
}

# A page where there is no OMPL.
case_pages() {
  if ! has pages; then
    echo "pages: left out (it is not installed)"
    return
  fi
  configure pages -D CMAKE_DISABLE_FIND_PACKAGE_ompl=ON -D EXAMPLE="$root/planners_demo/examples/14_page.cpp"
  cmake --build "$temporary/pages"
  "$temporary/pages/page" "$root/models" || fail "the page is wrong"
  if ldd "$temporary/pages/page" | grep -E 'libompl|libboost|libcrypto'; then fail "the program needs these libraries"; fi
}

# The same programs by pkg-config alone.
case_pkg_config() {
  if ! command -v pkg-config >/dev/null; then
    echo "pkg_config: left out (needs pkg-config)"
    return
  fi
  export PKG_CONFIG_PATH="$library_folder/pkgconfig"
  local static=() module words
  if [[ "$is_static" == ON ]]; then static=(--static); fi
  for module in "${installed[@]}"; do
    pkg-config --print-errors --validate "swept-${module//_/-}" || fail "swept-${module//_/-}.pc is not valid"
  done
  words="$(pkg-config "${static[@]}" --cflags --libs swept-core)"
  [[ " $words " == *" -ffp-contract=off "* ]] || fail "no -ffp-contract=off in '$words'"
  compile_by_words "$here/core/distance.cpp" "$words"
  "$temporary/by_words" || fail "the core's answers are wrong"
  if has proofs; then
    words="$(pkg-config "${static[@]}" --cflags --libs swept-proofs)"
    compile_by_words "$root/planners_demo/examples/13_certify_path.cpp" "$words"
    "$temporary/by_words" "$root/models" || fail "the proof is wrong"
  fi
  if has pages; then
    words="$(pkg-config "${static[@]}" --cflags --libs swept-pages)"
    compile_by_words "$root/planners_demo/examples/14_page.cpp" "$words"
    "$temporary/by_words" "$root/models" || fail "the page is wrong"
  fi
  if ! has ompl_bridge; then return; fi
  words="$(pkg-config "${static[@]}" --cflags --libs swept-ompl-bridge)"
  compile_by_words "$here/full/motion.cpp" "$words"
  "$temporary/by_words" "$root/models/robots/rook7/rook7.urdf" "$root/models/scenes/narrow_slot.yaml" ||
    fail "the certificates are wrong"
}

# compile_by_words SOURCE FLAGS: into $temporary/by_words.
compile_by_words() {
  # shellcheck disable=SC2086
  "$compiler" -std=c++20 $flags "$1" $2 -Wl,-rpath,"$library_folder" -o "$temporary/by_words"
}

# What no proof holds for is refused: by every header of the core, and when programs are linked.
case_flags() {
  local header headers command=("$compiler" -std=c++20 -I "$prefix/include" -isystem "$(eigen_folder)" -x c++)
  mapfile -t headers < <(cd "$prefix/include" && find swept/core -name '*.hpp')
  ((${#headers[@]} > 20)) || fail "only ${#headers[@]} headers"
  for header in "${headers[@]}"; do
    echo "#include \"$header\"" >"$temporary/one.cpp"
    refuses 'swept: nothing is proven with -ffast-math' "${command[@]}" -ffast-math -Wfatal-errors -E "$temporary/one.cpp"
  done
  echo '#include "swept/core/shapes.hpp"' >"$temporary/one.cpp"
  "${command[@]}" -E "$temporary/one.cpp" >"$temporary/said" || fail "a program without flags is refused"
  refuses 'swept: nothing is proven with -ffast-math' "${command[@]}" -Ofast -E "$temporary/one.cpp"
  refuses 'swept: nothing is proven with -ffast-math' "${command[@]}" -ffinite-math-only -E "$temporary/one.cpp"
  refuses 'swept: nothing is proven with operations in excess precision' \
    "${command[@]}" -U__FLT_EVAL_METHOD__ -D__FLT_EVAL_METHOD__=2 -E "$temporary/one.cpp"

  # As with another -march than the library's: poses would lie elsewhere.
  configure core -D CMAKE_CXX_FLAGS="$flags -DEIGEN_MAX_STATIC_ALIGN_BYTES=128"
  refuses 'libraryAlignsEigenTypesTo<128,' cmake --build "$temporary/core"
  # And this is what -mavx leaves of a difference with -DEIGEN_MAX_ALIGN_BYTES=16.
  configure core -D CMAKE_CXX_FLAGS="$flags -DEIGEN_MALLOC_ALREADY_ALIGNED=0"
  refuses ', false>' cmake --build "$temporary/core"
}

# refuses TEXT COMMAND...: the command fails, and says this.
refuses() {
  if "${@:2}" >"$temporary/said" 2>&1; then fail "not refused: ${*:2}"; fi
  grep -qF -e "$1" "$temporary/said" || fail "not '$1' but: $(cat "$temporary/said")"
}

eigen_folder() { echo "$(cached Eigen3_DIR)" | sed 's|/share/eigen3/cmake$|/include/eigen3|'; }

# The program, from where it was moved to.
case_program() {
  if [[ ! -x "$prefix/bin/swept" ]]; then
    echo "program: left out (it was not built)"
    return
  fi
  local robot="$root/models/robots/rook7/rook7.urdf" scene="$root/models/scenes/narrow_slot.yaml" status=0
  [[ "$("$prefix/bin/swept" --version)" == "swept $(cached CMAKE_PROJECT_VERSION)" ]] || fail "another version"
  "$prefix/bin/swept" info "$robot" >"$temporary/said"
  grep -q rook7 "$temporary/said" || fail "info says: $(cat "$temporary/said")"
  local page=()
  if [[ -f "$prefix/share/doc/swept/three_licence.txt" ]]; then page=(--html "$temporary/page.html"); fi
  "$prefix/bin/swept" motion "$robot" home ready --group arm --scene "$scene" "${page[@]}" \
    >"$temporary/said" || status=$?
  ((status == 1)) || fail "exit code $status of a motion in collision: $(cat "$temporary/said")"
  grep -q collision "$temporary/said" || fail "motion says: $(cat "$temporary/said")"
  if ((${#page[@]} > 0)); then grep -q '</html>' "$temporary/page.html" || fail "no page"; fi
}

# The manual pages: whole, as the program says of itself, and in order.
case_manual() {
  if [[ ! -x "$prefix/bin/swept" ]]; then
    echo "manual: left out (the program was not built)"
    return
  fi
  local page pages=("$prefix/share/man/man1"/*.gz) name
  for name in swept swept-mpi; do
    if [[ ! -x "$prefix/bin/$name" ]]; then continue; fi
    [[ " ${pages[*]} " == *"/$name.1.gz "* ]] || fail "no manual page of $name"
  done
  for page in "${pages[@]}"; do
    gzip -dc "$page" >"$temporary/page.1"
    if command -v man >/dev/null; then
      MANROFFSEQ="" man --warnings -l "$temporary/page.1" >/dev/null 2>"$temporary/said"
      [[ ! -s "$temporary/said" ]] || fail "man says of $page: $(cat "$temporary/said")"
    fi
    if command -v mandoc >/dev/null; then
      mandoc -T lint -W warning "$temporary/page.1" || fail "mandoc is not content with $page"
    fi
  done
  if ! command -v mandoc >/dev/null; then
    echo "manual: what is on the page left out (needs mandoc)"
    return
  fi
  page_says_what_the_program_says
}

# Under the heading of each subcommand that completion has: each text of its help, and each of its options.
page_says_what_the_program_says() {
  gzip -dc "$prefix/share/man/man1/swept.1.gz" | mandoc -T utf8 -O width=1000 |
    LC_ALL=C.UTF-8 sed 's/.\x08//g' >"$temporary/page.txt"
  local commands command options option text
  mapfile -t commands < <("$prefix/bin/swept" completion fish |
    sed -n "s/^complete .* '__fish_use_subcommand' -a \([a-z]*\) -d .*/\1/p
      s/^complete .* '__fish_seen_subcommand_from \([a-z]*\)' -a \([a-z]*\) -d .*/\1 \2/p")
  ((${#commands[@]} > 5)) || fail "only these subcommands: ${commands[*]}"
  for command in "${commands[@]}"; do
    # Headings are set in by three.
    awk -v heading="   swept $command" '/^[^ ]/ || /^   [^ ]/ { inside = $0 == heading } inside' \
      "$temporary/page.txt" | sed 's/^ *//' >"$temporary/part.txt"
    options="$("$prefix/bin/swept" completion words "swept $command -")"
    for option in $options; do
      grep -qE -e "^(-[a-z], )?$option( |,|\$)" "$temporary/part.txt" || fail "no $option of '$command' on the page"
    done
    while read -r text; do
      grep -qF -e "$text" "$temporary/part.txt" || fail "not on the page, of '$command': $text"
    done < <(texts_of_help "$command")
  done
}

# Without the names of arguments and options, which take 30 columns or a line.
texts_of_help() {
  # shellcheck disable=SC2086
  "$prefix/bin/swept" $1 --help | sed -e 's/^Usage: //' -e 's/ REQUIRED$/ (required)/' -e 's/ Needs: [^ ]*$//' -e 's/ Excludes: .*$//' -e 's/^ *\(-[a-z]\),\(--[^ ]* [A-Z]*\)$/\1, \2/' -e '/^Positionals:$/,/^$/s/^.\{30\}//' \
    -e '/^Options:$/,/^$/s/^.\{30\}//' -e '/^\(Positionals\|Options\):$/d' -e '/^$/d'
}

# What bare_debian.sh refuses before it does anything.
case_bare_options() {
  local bare="$here/bare_debian.sh"
  refuses 'error: no step '"'tets'"'; there are: debian demo tests' "$bare" "$temporary/bare" --only tets
  refuses 'error: --only names no step; there are: debian' "$bare" "$temporary/bare" --only --keep
  refuses "error: no option '--kep'; there are: --suite --keep --only --help" "$bare" "$temporary/bare" --kep
  refuses "error: no suite 'sid'; there are: bookworm trixie" "$bare" "$temporary/bare" --suite sid
  refuses 'error: --suite needs a value, one of: bookworm trixie' "$bare" "$temporary/bare" --suite
  mkdir "$temporary/of_trixie"
  echo trixie >"$temporary/of_trixie/suite"
  refuses "of_trixie is of the suite 'trixie', not 'bookworm'" "$bare" "$temporary/of_trixie" --suite bookworm --only demo
  refuses "error: a second folder, '/tmp'; one is taken" "$bare" "$temporary/bare" /tmp
  refuses 'usage: tests/packaging/bare_debian.sh FOLDER' "$bare"
  [[ ! -e "$temporary/bare" ]] || fail "bare_debian.sh makes a folder for what it refuses"
}

# What arm64.sh and same_answers.sh refuse before they do anything.
case_arm_options() {
  local arm="$here/arm64.sh" same="$here/same_answers.sh" none="$temporary/none"
  refuses 'usage: tests/packaging/arm64.sh FOLDER' "$arm"
  refuses "error: no option '--test'; there are: --tests --each --target --help" "$arm" "$none" --test core
  refuses 'error: --tests needs a value' "$arm" "$none" --tests
  refuses 'error: --each needs a value' "$arm" "$none" --each
  local seconds
  for seconds in 0 -1 5s ''; do
    refuses "error: --each is '$seconds'; it takes seconds, a whole number from 1" "$arm" "$none" --each "$seconds"
  done
  refuses "error: a second folder, '/tmp'; one is taken" "$arm" "$none" /tmp
  mkdir "$temporary/programs"
  ln -s "$(command -v bash)" "$(command -v dirname)" "$temporary/programs"
  refuses 'error: these programs are missing: aarch64-linux-gnu-g++ qemu-aarch64-static cmake' \
    env PATH="$temporary/programs" bash "$arm" "$none"
  [[ ! -e "$none" ]] || fail "arm64.sh makes a folder for what it refuses"
  refuses 'usage: tests/packaging/same_answers.sh BUILD OTHER FOLDER' "$same" "$build"
  refuses "error: no $temporary/tests/answers/swept_answers_record; build the targets" "$same" "$temporary" "$temporary" "$temporary/said_of"
}

# The same of wasm.sh.
case_wasm_options() {
  local wasm="$here/wasm.sh" none="$temporary/none"
  refuses 'usage: tests/packaging/wasm.sh FOLDER' "$wasm"
  refuses "error: no option '--tests'; there are: --check --help" "$wasm" "$none" --tests core
  refuses 'error: --check needs a value' "$wasm" "$none" --check
  refuses "error: --check: '$temporary/swept' is no program" "$wasm" "$none" --check "$temporary/swept"
  refuses "error: a second folder, '/tmp'; one is taken" "$wasm" "$none" /tmp
  mkdir "$temporary/programs"
  ln -s "$(command -v bash)" "$(command -v dirname)" "$temporary/programs"
  refuses 'error: these programs are missing: emcc node cmake' env PATH="$temporary/programs" bash "$wasm" "$none"
  [[ ! -e "$none" ]] || fail "wasm.sh makes a folder for what it refuses"
}

# The same of windows.sh.
case_windows_options() {
  local windows="$here/windows.sh" none="$temporary/none"
  refuses 'usage: tests/packaging/windows.sh FOLDER' "$windows"
  refuses "error: no option '--check'; there are: --tests --help" "$windows" "$none" --check swept
  refuses 'error: --tests needs a value' "$windows" "$none" --tests
  refuses "error: a second folder, '/tmp'; one is taken" "$windows" "$none" /tmp
  mkdir "$temporary/programs"
  ln -s "$(command -v bash)" "$(command -v dirname)" "$temporary/programs"
  # Wine may be there, outside the path.
  refuses 'x86_64-w64-mingw32-g++-posix cmake ninja apt-get' env PATH="$temporary/programs" bash "$windows" "$none"
  [[ ! -e "$none" ]] || fail "windows.sh makes a folder for what it refuses"
}

case_wheel_options() {
  local wheel="$here/wheel.sh" none="$temporary/none"
  refuses 'error: usage: wheel.sh FOLDER [PYTHON]...' "$wheel"
  refuses 'error: usage: wheel.sh FOLDER [PYTHON]...' "$wheel" --help
  mkdir "$temporary/programs"
  ln -s "$(command -v bash)" "$(command -v dirname)" "$temporary/programs"
  refuses 'error: no patchelf; install it first' env PATH="$temporary/programs" bash "$wheel" "$none"
  [[ ! -e "$none" ]] || fail "wheel.sh makes a folder for what it refuses"
}

# What .ci/nightly refuses before it installs anything, and what it would install where.
case_ci_options() {
  local all='error: usage: .ci/nightly WHAT, where WHAT is one of: arm asan clang fuzz tsan'
  refuses "$all" "$root/.ci/nightly"
  refuses "$all" "$root/.ci/nightly" msan
  refuses "$all" "$root/.ci/nightly" asan tsan
  mkdir -p "$temporary/tree/.ci"
  printf 'swept-none # a comment\n\n# swept-said\nswept-less\nbash\n' >"$temporary/tree/.ci/list.txt"
  printf '# why\nswept-less # here\n' >"$temporary/tree/.ci/not-on-less.txt"
  missing_on less 'swept-none'
  missing_on more 'swept-none swept-less'
}

# The packages that would be installed on a system: missing_on SYSTEM PACKAGES.
missing_on() {
  local said
  if ! command -v dpkg-query >/dev/null; then return; fi
  said="$(root="$temporary/tree" bash -euc 'source "$1"; missing_packages "$root/.ci/list.txt" "$2"' - \
    "$root/.ci/setup.sh" "$1" | xargs)"
  [[ "$said" == "$2" ]] || fail "on $1 '$said' would be installed, not '$2'"
}

# swept's sources in another build, by FetchContent: that is configured, and the program compiled. Compiling the core once
# more takes minutes, so the finished one is put into the command that links the program.
case_tree() {
  if [[ "$(cached CMAKE_GENERATOR)" != Ninja ]]; then
    echo "tree: left out (needs a build by Ninja)"
    return
  fi
  configure tree -D SWEPT_SOURCES="$root"
  cmake --build "$temporary/tree" --target distance_object
  local link library
  link="$("$(cached CMAKE_MAKE_PROGRAM)" -C "$temporary/tree" -t commands distance | tail -n 1)"
  library="$(find "$library_folder" -name libswept_core.a -o -name libswept_core.so)"
  [[ "$link" == *" _deps/swept-build/core/libswept_core.a "* ]] || fail "the core is not in: $link"
  (cd "$temporary/tree" && eval "${link/_deps\/swept-build\/core\/libswept_core.a/$library}")
  LD_LIBRARY_PATH="$library_folder" "$temporary/tree/distance" || fail "the core's answers are wrong"
}

# The same, and all of the core compiled in that build.
case_whole_tree() {
  configure tree -D SWEPT_SOURCES="$root" -D CMAKE_BUILD_TYPE=Debug -D CMAKE_CXX_FLAGS="$flags -O0 -g0"
  cmake --build "$temporary/tree" --target distance --parallel 2
  "$temporary/tree/distance" || fail "the core's answers are wrong"
}
