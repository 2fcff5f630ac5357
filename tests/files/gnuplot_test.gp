# The CSV of a run in gnuplot, by the names of its first line.
set datafile separator comma
set format x '%.17g'
set format y '%.17g'
set table 'table_1,3'
plot 'double.csv' using 't':'a.y'
set table 'table_2,10'
plot 'double.csv' using 'a.x':'lambda1'
