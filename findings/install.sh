# Sourced by each script of this folder: goes to a temporary folder, which is removed at the end, and
# installs other people's packages there.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
chmod 755 "$folder" # apt-get downloads as another user
cd "$folder"

# npm_packages NAME@VERSION…
npm_packages() {
  npm install --no-audit --no-fund --loglevel=error "$@" >/dev/null || exit 2
  printf 'version: %s\n' "$@"
}

# debian_packages VERSION PACKAGE…: PACKAGE… and what they need and the system lacks, unpacked. The
# first has to have a version that begins with VERSION.
debian_packages() {
  local version=$1 name
  shift
  mkdir -p archives/partial
  apt-get -qq -o Debug::NoLocking=1 -o Dir::Cache::archives="$folder/archives" install --download-only \
    --reinstall --yes --no-install-recommends "$@" >/dev/null || exit 2
  for name in archives/*.deb; do dpkg -x "$name" .; done
  name=$(dpkg-deb -W archives/"$1"_*.deb)
  echo "version: Debian's $name"
  [[ $name == *$'\t'"$version"* ]] || { echo "this was found with version $version" >&2; exit 2; }
}

# expect TEXT FOUND WANTED: the behaviour, and whether it is as it was found.
expect() {
  echo "seen: $1: $2"
  [[ $2 == "$3" ]] || { echo "CHANGED: it was $3" >&2; exit 1; }
}
