#include <nlohmann/json.hpp>
#include <set>

#include "checksum.hpp"
#include "cli/program.hpp"

namespace hbvm::core {
namespace {

using Json = nlohmann::json;

const char* const gauss_tableau = R"(name = "Gauss"
A = [["1/4", "1/4-sqrt(3)/6"], ["1/4+sqrt(3)/6", "1/4"]]
b = ["1/2", "1/2"]
)";
const char* const wrong_digit = R"toml(name = "Gauss, a digit wrong"
A = [["1/4", "1/4-sqrt(3)/6"], ["1/4+sqrt(3)/6+10^(-25)", "1/4"]]
b = ["1/2", "1/2"]
c = ["1/2-sqrt(3)/6", "1/2+sqrt(3)/6"]
)toml";

Json claims_of(const Arguments& arguments, int code) {
  return Json::parse(ended_with(code, Arguments{"audit", "--json"} + arguments, 600).out).at("claims");
}

std::vector<std::string> verdicts_of(const Json& claims) {
  std::vector<std::string> result;
  for (const Json& claim : claims) result.push_back(claim.at("verdict"));
  return result;
}

TEST(AuditCommand, QuickHoldsForEveryClaim) {
  const Folder folder;
  const Json claims = claims_of({"--quick", "--out", folder / "out"}, 0);
  EXPECT_FALSE(text_of(folder / "out/orders.svg").empty());
  EXPECT_GE(claims.size(), 40u);
  std::set<std::string> precisions;
  for (const Json& claim : claims) {
    EXPECT_EQ(claim.at("verdict"), "holds") << claim.dump();
    for (const char* const key : {"claim", "quantity", "problem", "precision"})
      EXPECT_TRUE(claim.at(key).is_string()) << key;
    for (const char* const key : {"k", "s", "predicted"}) EXPECT_TRUE(claim.at(key).is_number()) << key;
    for (const char* const key : {"measured", "uncertainty"})
      EXPECT_TRUE(claim.at(key).is_number() || claim.at(key).is_null()) << key;
    precisions.insert(claim.at("precision"));
  }
  EXPECT_TRUE(precisions.contains("mpfr:100"));
}

TEST(AuditCommand, WritesTables) {
  const Folder folder;
  const Outcome outcome = ended_with(0, {"audit", "--claims", "simple_pendulum", "--out", folder / "out"}, 600);
  expect_words(outcome.out, {"0 fail, 0 undecidable"});
  EXPECT_EQ(outcome.err, "");
  for (const char* const file : {"audit.csv", "audit.md", "audit.tex"})
    EXPECT_FALSE(text_of(folder / ("out/" + std::string(file))).empty()) << file;
  EXPECT_EQ(lines_of(text_of(folder / "out/audit.csv")).at(0),
            "problem,claim,quantity,over,k,s,predicted,measured,+-,precision,coefficients to,verdict,reason");
  expect_words(text_of(folder / "out/audit.csv-metadata.json"), {"command hbvm audit --claims 'simple_pendulum'"});
}

TEST(AuditCommand, AuditsATableau) {
  const Folder folder;
  for (const Json& claim : claims_of({"--method", folder.write("gauss.toml", gauss_tableau)}, 0)) {
    EXPECT_EQ(claim.at("verdict"), "holds") << claim.dump();
    EXPECT_TRUE(claim.at("k").is_null());
    EXPECT_EQ(claim.at("method"), "Gauss");
  }
  const Json bad = claims_of({"--method", folder.write("wrong.toml", wrong_digit)}, 1);
  EXPECT_EQ(bad.at(0).at("reason"), "the conditions of order 2 are met to 25 digits only");
  const auto verdicts = verdicts_of(bad);
  EXPECT_GE(std::count(verdicts.begin(), verdicts.end(), "fails"), 4);
}

/// Each false, each alone.
TEST(AuditCommand, RefusesFalseClaims) {
  const Folder folder;
  folder.write("wrong.toml", wrong_digit);
  const char* const claims[] = {
      "quantity = \"raw p\"\nproblem = \"modified_pendulum\"\nmethod = \"hbvm:3,3\"\nrate = \"2*s\"\n",
      "quantity = \"raw p\"\nproblem = \"modified_pendulum\"\nmethod = \"hbvm:1,1\"\nover = \"step\"\nrate = \"s+2\"\n",
      "quantity = \"delta lambda\"\nproblem = \"modified_pendulum\"\nmethod = \"hbvm:2,2\"\nrate = \"s\"\n",
      "quantity = \"H\"\nproblem = \"modified_pendulum\"\nmethod = \"hbvm:2,2\"\nrate = \"round-off\"\n",
      "quantity = \"q\"\nproblem = \"kepler\"\nmethod = \"wrong.toml\"\nrate = \"2*s\"\n"};
  for (const char* const claim : claims)
    EXPECT_EQ(verdicts_of(claims_of({"--claims", folder.write("claims.toml", "[[claim]]\n" + std::string(claim))}, 1)),
              std::vector<std::string>{"fails"})
        << claim;
}

/// 0: all hold; 1: one fails; 4: none fails, but not all hold. What cannot be run takes no other verdict with it.
TEST(AuditCommand, TellsByItsCodeWhetherAllCouldBeDecided) {
  const Folder folder;
  const auto claim = [](const std::string& quantity, const std::string& problem, const std::string& method,
                        const std::string& rate) {
    return "[[claim]]\nquantity = \"" + quantity + "\"\nproblem = \"" + problem + "\"\nmethod = \"" + method +
           "\"\nrate = " + rate + "\n";
  };
  const std::string holds = claim("q", "kepler", "hbvm:1,1", "2"), fails = claim("q", "kepler", "hbvm:1,1", "\"2.05\""),
                    degenerate = claim("raw p", "conical_pendulum", "hbvm:2,2", "4");
  const auto verdicts = [&](const std::string& claims, int code, const Arguments& further = {}) {
    return verdicts_of(claims_of(Arguments{"--claims", folder.write("claims.toml", claims)} + further, code));
  };
  using Verdicts = std::vector<std::string>;
  EXPECT_EQ(verdicts(holds, 0), Verdicts{"holds"});
  EXPECT_EQ(verdicts(holds + degenerate, 4), (Verdicts{"holds", "degenerate"}));
  EXPECT_EQ(verdicts(degenerate + fails + holds, 1), (Verdicts{"degenerate", "fails", "holds"}));
  EXPECT_EQ(verdicts(holds, 4, {"--limit", "0.001"}), Verdicts{"undecidable"});
  // The start lies on the singularity of the potential.
  folder.write("impossible.toml", R"(dimension = 2
point = [{ name = "o", position = [0, 0] }]
body = [{ name = "a", mass = 1, position = [0, 0], velocity = [0, 1] }]
effect = [{ kind = "central_gravity", center = "o", strength = 1 }]
)");
  const std::string impossible = claim("q", "impossible.toml", "hbvm:1,1", "2");
  EXPECT_EQ(verdicts(impossible + holds, 4), (Verdicts{"not run", "holds"}));
}

TEST(AuditCommand, TellsWhatItLookedAt) {
  const Folder folder;
  const std::string claims =
      "[[claim]]\nquantity = \"q\"\nproblem = \"modified_pendulum\"\nmethod = \"hbvm:1,1\"\nrate = 2\n";
  const Json claim = claims_of({"--claims", folder.write("claims.toml", claims), "--until", "3*2"}, 0).at(0);
  EXPECT_EQ(claim.at("coefficients_to"), 1000);
  EXPECT_EQ(claim.at("interval").at(0), 0);
  EXPECT_GE(claim.at("interval").at(1), 6);
  EXPECT_GT(claim.at("seconds"), 0);
}

TEST(AuditCommand, FullGoesOnFromWhatItFound) {
  const Folder folder;
  const Arguments arguments{"audit", "--full", "--claims", "costo", "--out", folder / "out"};
  const Outcome first = ended_with(0, arguments, 600);
  // As if it had been ended in the middle of a line.
  const std::string store = folder / "out/findings.jsonl", all = text_of(store);
  folder.write(store, all.substr(0, all.size() / 2));
  EXPECT_EQ(ended_with(0, arguments, 600).out, first.out);
  EXPECT_EQ(text_of(store), all);
  // Nothing is found again: another measurement under the seal of the first line is believed.
  const std::size_t end = all.find(",\"checksum\":");
  std::string line = all.substr(0, end);
  const std::size_t measured = line.find("\"measured\":");
  ASSERT_NE(measured, std::string::npos) << line;
  line.replace(measured, line.find(',', measured) - measured, "\"measured\":0.765");
  line += ",\"checksum\":\"" + Checksum(line).text() + "\"}";
  folder.write(store, line + all.substr(all.find('\n')));
  EXPECT_EQ(first.out.find("0.765"), std::string::npos) << first.out;
  expect_words(ended_with(0, arguments, 600).out, {"0.765"});
}

/// Of three computers, each with a third of the work; the last line of one was cut off.
TEST(AuditCommand, MergesShardsToTheSameFiles) {
  const Folder folder;
  const Arguments work{"audit", "--claims", "simple_pendulum"};
  const auto files = [&](const std::string& of) {
    std::vector<std::string> texts;
    for (const char* const name : {"/findings.jsonl", "/audit.csv", "/audit.md"}) {
      texts.push_back(text_of(folder / (of + name)));
      // Provenance.
      std::erase(texts.back(), '\r');
    }
    return texts;
  };
  std::vector<std::string> merged{"--merge"};
  for (const char* const shard : {"1/3", "2/3", "3/3"}) {
    const std::string out = folder / (std::string("shard") + shard[0]);
    ended_with(0, work + Arguments{"--shard", shard, "--out", out}, 600);
    merged.push_back(out + "/findings.jsonl");
  }
  const std::string cut = text_of(merged[2]);
  folder.write(merged[2], cut.substr(0, cut.size() - 5));
  const Arguments to_merged{"--out", folder / "merged"};
  expect_words(ended_with(2, work + merged + to_merged, 600).err, {"damaged"});
  folder.write(merged[2], cut);
  const Arguments part{"--merge", merged[1], merged[2], "--out", folder / "part"};
  expect_words(ended_with(2, work + part, 600).err, {"in none of these files"});
  ended_with(0, work + merged + to_merged, 600);
  ended_with(0, work + Arguments{"--shard", "1/1", "--jobs", "1", "--out", folder / "one"}, 600);
  EXPECT_EQ(files("merged")[0], files("one")[0]);
  EXPECT_EQ(lines_of(files("merged")[1]).size(), lines_of(files("one")[1]).size());
  expect_refused({"audit", "--shard", "4/3", "--out", folder / "x"}, {"4/3"});
  expect_refused({"audit", "--json", "--shard", "1/3"}, {"--out"});
  expect_refused({"audit", "--shard", "1/3", "--merge", merged[1], "--out", folder / "x"}, {"--merge"});
}

TEST(AuditCommand, RefusesBadInput) {
  const Folder folder;
  expect_refused({"audit", "--claims", "no such claim"}, {"no such claim", "evaik"});
  expect_refused({"audit", "--claims", folder / "absent.toml"}, {"absent.toml"});
  expect_refused({"audit", "--method", folder / "absent.toml"}, {"absent.toml"});
  expect_refused({"audit", "--method", folder.write("bad.toml", "A = [[1, 2]]\nb = [1]\n")}, {"bad.toml", "A"});
  expect_refused({"audit", "--jobs", "0"}, {"--jobs"});
  expect_refused({"audit", "--limit", "-1"}, {"--limit"});
  expect_refused({"audit", "--until", "0"}, {"--until", "0"});
  expect_refused({"audit", "--until", "soon"}, {"--until", "soon"});
  expect_refused({"audit", "--quick", "--full"}, {"--full"});
  expect_refused({"audit", "--out", "/proc/nowhere"}, {"/proc/nowhere"});
  const std::string polynomials =
      "[[claim]]\nquantity = \"u and v\"\nproblem = \"double_pendulum\"\nmethod = \"rattle\"\nover = \"step\"\nrate = "
      "2\n";
  expect_refused({"audit", "--json", "--claims", folder.write("claims.toml", polynomials)}, {"rattle", "polynomials"});
}

/// By its name a method is held to what it says of itself.
TEST(AuditCommand, DecidesWhatAMethodSaysOfItself) {
  EXPECT_EQ(verdicts_of(claims_of({"--method", "energy_momentum", "--claims", "kepler"}, 0)),
            std::vector<std::string>(5, "holds"));
  const Json tolerance = claims_of({"--method", "bulirsch_stoer:9", "--claims", "kepler"}, 0);
  EXPECT_GE(tolerance.at(0).at("measured"), 7.0) << tolerance.dump();
  expect_refused({"audit", "--json", "--method", "hbvm:auto,2"}, {"hbvm:auto,2"});
  expect_refused({"audit", "--json", "--method", "lobatto:1"}, {"lobatto:1"});
}

TEST(AuditCommand, DecidesClaimsAboutEveryMethod) {
  const Folder folder;
  folder.write("gauss.toml", gauss_tableau);
  const auto audited = [&](const std::vector<std::string>& all, int code, const std::string& verdict) {
    std::string claims;
    for (const std::string& claim : all) claims += "[[claim]]\nproblem = \"double_pendulum\"\n" + claim;
    for (const Json& claim : claims_of({"--claims", folder.write("claims.toml", claims)}, code))
      EXPECT_EQ(claim.at("verdict"), verdict) << claim.dump();
  };
  const auto of = [](const char* method, const char* quantity, const char* rate) {
    return std::string("method = \"") + method + "\"\nquantity = \"" + quantity + "\"\nrate = " + rate + "\n";
  };
  const char* const round_off = "\"round-off\"";
  // The hidden constraints are quadratic invariants of the index-reduced equations, which Gauss methods keep.
  audited(
      {of("rattle", "q", "2"), of("rattle", "tangential p", "2"), of("rattle", "g", round_off),
       of("rattle", "hidden", round_off), of("rattle", "reversal", round_off), of("compose:rattle,4", "q", "4"),
       of("compose:rattle,4", "hidden", round_off), of("compose:rattle,6", "tangential p", "6"),
       of("gauss.toml", "q", "4"), of("gauss.toml", "hidden", round_off), of("tableau:gauss.toml+project", "q", "4"),
       of("tableau:gauss.toml+project", "g", round_off), of("tableau:gauss.toml+project", "hidden", round_off)},
      0, "holds");
  audited({of("rattle", "q", "3"), of("rattle", "H", round_off), of("compose:rattle,4", "q", "5"),
           of("gauss.toml", "g", round_off), of("tableau:gauss.toml+project", "H", round_off)},
          1, "fails");
}

/// Coefficients of any family are held against their conditions alone; the wrong entry is named, and mended in a file.
TEST(AuditCommand, FindsAWrongEntryInAFile) {
  const Folder folder;
  const std::string right = "A = [[0,0,0,0],['1/2',0,0,0],[0,'1/2',0,0],[0,0,1,0]]\nb = ['1/6','1/3','1/3','1/6']\n";
  std::string wrong = right;
  wrong.replace(wrong.rfind("1/3"), 3, "1/8");
  const std::string good = folder.write("good.toml", right), bad = folder.write("bad.toml", wrong),
                    kicks = folder.write("kicks.json", R"({"a": ["1/2", "1/2"], "b": [1]})");
  EXPECT_EQ(ended_with(0, {"audit", good, "--order", "4"}).out, good + ": holds: order 4\n");
  EXPECT_EQ(ended_with(1, {"audit", bad, "--order", "4", "--write", folder / "mended.toml"}).out,
            bad + ": fails: order 0; b[3] = 1/3, in place of 1/8\n");
  expect_words(ended_with(0, {"audit", folder / "mended.toml"}).out,
               {"order 4; its conditions are met exactly", "holds"});
  expect_words(ended_with(1, {"audit", bad}).out, {"repair: b[3] = 1/3, in place of 1/8", "fails"});
  EXPECT_EQ(Json::parse(ended_with(1, {"audit", bad, "--json"}).out).at("repair").at(0).at("exact"), "1/3");
  // A file that is no plain tableau is one of these also by --method.
  expect_words(ended_with(0, {"audit", "--method", kicks}).out, {"family splitting", "order 2"});
}

TEST(AuditCommand, RefusesWhatIsNotForAFile) {
  const Folder folder;
  const std::string file = folder.write("euler.toml", "A = [[0]]\nb = [1]\n");
  expect_refused({"audit", file, "--quick"}, {"FILE", "conditions alone"});
  expect_refused({"audit", file, "--method", "rk4"}, {"FILE and --method"});
  expect_refused({"audit", "--method", "rk4", "--order", "4"}, {"--order", "FILE"});
  expect_refused({"audit", file, "--write", folder / "mended.toml"}, {"nothing to mend"});
  expect_refused({"audit", "nowhere.toml"}, {"nowhere.toml"});
}

/// Programs of others are judged by their runs.
TEST(AuditCommand, JudgesPrograms) {
  const std::string own = "python3 " HBVM_SOURCE_DIR "/studies/own_program/integrator.py ",
                    rest = " {scene} {step} {until} {out}";
  const auto arguments = [&](const std::string& method, const std::string& order) {
    return Arguments{"audit", "--command", own + method + rest, "--order", order, "--until", "2", "--json"};
  };
  const auto of = [](const Json& audit, const std::string& quantity) {
    std::vector<std::string> reasons;
    for (const Json& v : audit.at("verdicts"))
      if (v.at("quantity") == quantity) reasons.push_back(v.at("reason"));
    return reasons;
  };
  const Json rk4 = Json::parse(ended_with(0, arguments("rk4", "4"), 600).out);
  EXPECT_EQ(rk4.at("verdicts").size(), 9u);
  for (const std::string& reason : of(rk4, "reversal")) expect_words(reason, {"not symmetric"});
  const Json verlet = Json::parse(ended_with(0, arguments("verlet", "2"), 600).out);
  for (const std::string& reason : of(verlet, "reversal")) expect_words(reason, {"symmetric: it comes back"});
  const Json liar = Json::parse(ended_with(1, arguments("liar", "4"), 600).out);
  for (const Json& v : liar.at("verdicts"))
    if (v.at("quantity") == "order") {
      EXPECT_EQ(v.at("verdict"), "fails") << v.dump();
    }
  const Folder folder;
  const Arguments one{"audit", "--command", own + "verlet" + rest, "--order", "4", "--scene", "kepler", "--junit"};
  expect_words(ended_with(1, one + Arguments{folder / "junit.xml"}, 600).out, {"kepler", "claimed 4", "fails"});
  expect_words(text_of(folder / "junit.xml"), {"failures=\"1\""});
}

TEST(AuditCommand, SaysWhatAProgramDid) {
  const std::string places = " # {scene} {step} {until} {out}";
  expect_words(ended_with(4, {"audit", "--command", "echo nothing here; false" + places, "--scene", "kepler"}, 600).out,
               {"not run", "ended with code 1", "nothing here"});
  expect_words(ended_with(4, {"audit", "--command", "true" + places, "--scene", "kepler"}, 600).out,
               {"wrote no file at the place of {out}"});
  expect_refused({"audit", "--command", "true {scene}"}, {"--command", "{step}"});
  expect_refused({"audit", "--scene", "kepler"}, {"--scene", "--command"});
  expect_refused({"audit", "--command", "true" + places, "--quick"}, {"--command", "--order"});
}

/// The methods of the literature have the orders that their authors claim.
TEST(AuditCommand, HoldsForTheAtlas) {
  const std::string atlas = HBVM_SOURCE_DIR "/studies/atlas";
  const Json list = Json::parse(ended_with(0, {"audit", atlas, "--json"}, 600).out);
  EXPECT_GT(list.size(), 80u);
  for (const Json& found : list) {
    EXPECT_TRUE(found.at("holds")) << found.at("file");
    EXPECT_TRUE(found.at("orders").at(0).at("stated").is_number() || found.at("orders").size() > 1) << found.at("file");
  }
}

TEST(AuditCommand, GoesThroughAFolder) {
  const Folder folder;
  folder.write("one/right.toml", gauss_tableau);
  folder.write("wrong.toml", wrong_digit);
  folder.write("note.txt", "no coefficients");
  const std::string lines = ended_with(1, {"audit", folder.path()}, 600).out;
  expect_words(lines, {"one/right.toml: holds: order 4\n", "wrong.toml: fails: "});
  const Folder none;
  expect_refused({"audit", none.path()}, {"no .toml"});
  expect_refused({"audit", folder.path(), "--order", "4"}, {"folder", "--order"});
}

TEST(AuditCommand, WritesJunit) {
  const Folder folder;
  const std::string file = folder.write("gauss.toml", wrong_digit);
  ended_with(1, {"audit", file, "--junit", folder / "file.xml"}, 600);
  expect_words(text_of(folder / "file.xml"),
               {"<testcase classname=\"Gauss, a digit wrong\" name=\"order\"", "<failure"});
  ended_with(0, {"audit", "--claims", "simple_pendulum", "--junit", folder / "claims.xml"}, 600);
  expect_words(text_of(folder / "claims.xml"), {"failures=\"0\"", "classname=\"simple_pendulum\""});
}

}  // namespace
}  // namespace hbvm::core
