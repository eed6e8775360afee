# Default settings for the axes of a picture, or of one panel of several.
reset
set datafile separator ','
set datafile columnheaders
set border 3 lw 0.8
set tics nomirror out scale 0.6
set format '%g'
set key off
