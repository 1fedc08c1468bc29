#!/bin/sh
# Doxygen's filter of Markdown: folders' own descriptions are no pages of the reference, so links to
# them become their names.
exec sed -E 's#\[([^]]*)\]\(([./a-z]*README|CONTRIBUTING)\.md\)#\1#g' "$1"
