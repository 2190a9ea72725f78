// The gateway's remedies name commands of the tools, for all faces. This replaces them by the buttons of the
// page.

type Rule = [RegExp, string];

const kRules: Rule[] = [
  [/`nanoctl step`/g, "“Step”"],
  [/`nanoctl stop`/g, "“Stop”"],
  [/`nanoctl upload`/g, "“Upload…”"],
  [/`macreg set ERR_STAT [^`]*`/g, "“Reset error”"],
  [/with `nanoctl set-points`/g, "under “Set-points”"],
  [/`nanoctl status` and `nanoctl log` tell/g, "“State” and “Events” here tell"],
  [/`nanoctl log` tells/g, "“Events” here tells"],
  [/`nanoctl status` and `nanoctl watch` show/g, "“Sequence” here shows"],
  [/`nanoctl watch` shows/g, "“Sequence” here shows"],
  [/`nanoctl status` names/g, "“Active step” here names"],
];
const kRun = /`nanoctl run`/g;
const kBehindTheSwitch = /“(Run|Go on|Step|Upload…|Reset error)”/;

/** `isHeld`: the button is labelled Go on then. `operates`: the buttons that act are on the page. */
export function inPanel(remedy: string, isHeld: boolean, operates: boolean): string {
  let text = remedy.replace(kRun, isHeld ? "“Go on”" : "“Run”");
  for (const [command, button] of kRules) text = text.replace(command, button);
  if (!operates && kBehindTheSwitch.test(text)) text += " Press “Operate…” for that.";
  return text;
}
