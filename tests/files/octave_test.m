% The CSV of a run in Octave: by place, and by the names of its first line.
function value = numbers(json, key)  % "key": ["1.5", ...]
  list = regexp(json, ["^  \"" key "\": \\[([^\\]]*)\\]"], "tokens", "once", "lineanchors");
  value = str2double(regexp(list{1}, "[-0-9.e]+", "match"));
end

data = csvread("double.csv", 1, 0);
assert(size(data), [17, 20]);
assert(data(:, 1), (0:16)' / 16);

file = fopen("double.csv");
names = strsplit(fgetl(file), ",");
fclose(file);
column = @(name) data(:, strcmp(names, name));
json = fileread("double.json");
q = numbers(json, "q");
p = numbers(json, "p");
lambda = numbers(json, "lambda");
assert(numel(q), 4);
assert(data(end, 2:9), [q, p]);
assert(column("b.y")(end), q(4));
assert(column("a.px")(end), p(1));
assert(column("lambda2")(end), lambda(2));
assert(numel(column("output.lambda2")), 17);
