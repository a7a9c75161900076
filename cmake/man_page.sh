#!/bin/sh
# man_page.sh PROGRAM PAGE VERSION [SUBCOMMAND]: the command's help as PAGE.gz.
set -eu
program=$1 page=$2 version=$3 subcommand=${4:-}
title=exemplar${subcommand:+-$subcommand}
# A program of the page's name, whose help is the subcommand's.
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
printf '#!/bin/sh\n[ "$1" = --version ] && { echo "%s %s"; exit; }\nexec "%s" %s --help-all\n' \
  "$title" "$version" "$program" "$subcommand" > "$folder/$title"
chmod +x "$folder/$title"
if [ -n "$subcommand" ]; then
  # The description, which may be two lines.
  name=$("$program" "$subcommand" --help | awk '/^$/ { exit } { printf "%s%s", space, $0; space = " " }')
else
  name="more of one example mesh, map or label grid"
fi
# The help names the subcommand with a space, as it is typed.
help2man --no-info --no-discard-stderr --name "$name" --output "$page" "$folder/$title"
gzip -9nf "$page"
