#!/bin/sh
# Doxygen's filter of Markdown: folders' own descriptions are no pages of the reference, and Doxygen 1.9
# gives headings no names to link to, so links to either become their text.
exec sed -E 's#\[([^]]*)\]\(([./a-z]*README|CONTRIBUTING)\.md\)#\1#g; s/\[([^]]*)\]\(#[^)]*\)/\1/g' "$1"
