# SPDX-License-Identifier: AGPL-3.0-or-later
# Writes the file IN as the text NAME, declared in HEADER, into the C source OUT.
file(READ ${IN} bytes HEX)
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
file(WRITE ${OUT} "#include \"${HEADER}\"\nconst char ${NAME}[] = {${bytes}0};\n")
