// Values that may be changed while the machine is in use: visible to all clients, changed together, and saved
// as recipes. The gateway checks range and unit; a refusal is shown here with the limits of the value.
import { byId, h, saveFile, setClass, setText } from "./dom";
import type { Operation } from "./operate";
import type { Axis, Recipe, SetPoint } from "./state";

interface Row {
  element: HTMLTableRowElement;
  value: HTMLElement;
  input: HTMLInputElement;
  note: HTMLElement;
  known: string; // the gateway's value when the input was last set from it
}

const shown = (value: number, unit: string): string => (unit ? `${value} ${unit}` : String(value));

function rangeOf(point: SetPoint): string {
  const step = point.step > 0 ? ` in steps of ${shown(point.step, point.unit)}` : "";
  return `${shown(point.lowest, point.unit)} to ${shown(point.highest, point.unit)}${step}`;
}

export class SetPoints {
  private axis: Axis | null = null;
  private rows = new Map<string, Row>();
  private record = -1; // CRC of the record that the rows are for
  private recipes = "";
  private saves = true; // what the recipe's dialog is for
  private readonly body = byId("set-points");
  private readonly choice = byId<HTMLSelectElement>("recipe");
  private readonly problem = byId("set-points-problem");
  private readonly dialog = byId<HTMLDialogElement>("recipe-dialog");
  private readonly name = byId<HTMLInputElement>("recipe-name");
  private readonly importer = byId<HTMLDialogElement>("import-dialog");
  private readonly file = byId<HTMLInputElement>("import-file");

  constructor(private readonly operation: Operation) {
    byId<HTMLFormElement>("set-points-form").addEventListener("submit", (e) => {
      e.preventDefault();
      void this.change();
    });
    byId("set-points-undo").addEventListener("click", () => this.undo());
    this.choice.addEventListener("change", () => this.preview());
    byId("recipe-load").addEventListener("click", () => void this.load());
    byId("recipe-save").addEventListener("click", () => this.ask(true));
    byId("recipe-delete").addEventListener("click", () => this.ask(false));
    byId<HTMLFormElement>("recipe-form").addEventListener("submit", (e) => {
      e.preventDefault();
      void this.finish();
    });
    byId("recipe-cancel").addEventListener("click", () => this.dialog.close());
    this.name.addEventListener("input", () => this.describeSave());
    for (const format of ["csv", "toml"]) byId(`recipe-${format}`).addEventListener("click", () => void this.export(format));
    byId("recipe-import").addEventListener("click", () => this.openImport());
    byId("import-cancel").addEventListener("click", () => this.importer.close());
    byId<HTMLFormElement>("import-form").addEventListener("submit", (e) => {
      e.preventDefault();
      void this.import();
    });
  }

  show(axis: Axis): void {
    if (this.axis !== axis) this.record = -1;
    this.axis = axis;
  }

  update(axis: Axis): void {
    const kept = axis.setPoints;
    setClass(document.body, "has-set-points", kept.values.length > 0);
    if (kept.crc !== this.record) this.rebuild(axis);
    for (const point of kept.values) this.updateRow(point);
    this.updateRecipes(axis);
    setText(byId("set-points-state"), this.stateInWords(axis));
    setClass(byId("set-points-state"), "waiting", kept.waits || kept.damaged);
    const edited = [...this.rows.values()].some((row) => row.input.value !== row.known);
    byId<HTMLButtonElement>("set-points-change").disabled = !edited;
    byId<HTMLButtonElement>("set-points-undo").disabled = !edited;
  }

  private rebuild(axis: Axis): void {
    this.record = axis.setPoints.crc;
    this.recipes = "";
    this.rows = new Map(axis.setPoints.values.map((point) => [point.name, this.row(point)]));
    this.body.replaceChildren(...[...this.rows.values()].map((row) => row.element));
    setText(this.problem, "");
  }

  private row(point: SetPoint): Row {
    const range = h("td", { class: "quiet", id: `range-${point.name}` }, rangeOf(point));
    const value = h("span", { class: "set-point-value" });
    const input = h("input", { type: "text", inputmode: "decimal", autocomplete: "off", class: "operating-only",
      "aria-label": point.unit ? `${point.name} in ${point.unit}` : point.name, "aria-describedby": range.id });
    input.addEventListener("input", () => this.axis && this.update(this.axis));
    const note = h("span", { class: "set-point-note" });
    const unit = h("span", { class: "operating-only" }, point.unit);
    const element = h("tr", {}, h("th", { scope: "row" }, point.name), h("td", {}, value, h("span", { class: "set-point-input" }, input, unit), note), range);
    return { element, value, input, note, known: "" };
  }

  /** What somebody types stays; what another client changes is shown beside it. */
  private updateRow(point: SetPoint): void {
    const row = this.rows.get(point.name);
    if (!row) return;
    const text = String(point.value);
    const edited = row.input.value !== row.known;
    const theirs = edited && text !== row.known;
    if (!edited) {
      row.known = text;
      if (row.input.value !== text) row.input.value = text;
    }
    setText(row.value, shown(point.value, point.unit));
    setClass(row.element, "edited", edited);
    const force = point.in_force === point.value ? "" : `in force: ${shown(point.in_force, point.unit)}`;
    setText(row.note, [force, theirs ? `by now ${shown(point.value, point.unit)}` : ""].filter(Boolean).join("; "));
  }

  private stateInWords(axis: Axis): string {
    const kept = axis.setPoints;
    const parts: string[] = [];
    const active = kept.recipes.find((one) => one.number === kept.recipe);
    if (active) parts.push(`recipe ${active.name}${kept.differs ? ", changed since it was loaded" : ""}`);
    if (kept.waits) parts.push(`a change waits: it is taken in ${axis.boxNames(kept.takes)} or when the sequence stops`);
    if (kept.damaged) parts.push("the stored values are damaged, older ones or the defaults stand in: change some, or load a recipe");
    return parts.join("; ");
  }

  private updateRecipes(axis: Axis): void {
    const kept = axis.setPoints;
    const now = JSON.stringify([kept.recipes, kept.recipe]);
    if (now === this.recipes) return;
    this.recipes = now;
    const before = this.choice.value;
    this.choice.replaceChildren(...kept.recipes.map((one) => h("option", { value: one.name }, one.number === kept.recipe ? `${one.name} (loaded)` : one.name)));
    if (!kept.recipes.length) this.choice.append(h("option", { value: "" }, "none is saved"));
    const wanted = kept.recipes.find((one) => one.name === before) ?? kept.recipes.find((one) => one.number === kept.recipe) ?? kept.recipes[0];
    this.choice.value = wanted?.name ?? "";
    for (const id of ["recipe-load", "recipe-delete", "recipe-csv", "recipe-toml"]) byId<HTMLButtonElement>(id).disabled = !kept.recipes.length;
    this.preview();
  }

  private chosen(): Recipe | undefined {
    return this.axis?.setPoints.recipes.find((one) => one.name === this.choice.value);
  }

  /** What loading it would bring. */
  private preview(): void {
    const recipe = this.chosen();
    const points = this.axis?.setPoints.values ?? [];
    const missing = points.filter((point) => recipe && !(point.name in recipe.values)).map((point) => point.name);
    const values = points.filter((point) => recipe && point.name in recipe.values).map((point) => `${point.name} ${shown(recipe!.values[point.name], point.unit)}`);
    setText(byId("recipe-values"), [values.join(", "), missing.length && recipe ? `the default of ${missing.join(", ")}, of which it has no value that fits` : ""].filter(Boolean).join("; "));
  }

  private request(request: Record<string, unknown>): Promise<boolean> {
    return this.operation.wireAsk({ ...request, crc: this.axis?.setPoints.crc }).then((answer) => {
      setText(this.problem, answer.result === "done" ? "" : answer.text);
      return answer.result === "done";
    });
  }

  private undo(): void {
    for (const row of this.rows.values()) row.input.value = row.known;
    setText(this.problem, "");
    if (this.axis) this.update(this.axis);
  }

  private async change(): Promise<void> {
    const edited = [...this.rows].filter(([, row]) => row.input.value !== row.known);
    if (!edited.length) return;
    const sent = edited.map(([name, row]): [string, string] => [name, row.input.value]);
    if (!(await this.request({ do: "set_points", values: Object.fromEntries(sent) }))) return;
    for (const [name, text] of sent) {
      const row = this.rows.get(name);
      if (row?.input.value === text) row.known = row.input.value; // the next news replaces it
    }
    this.operation.notice(`Changed: ${sent.map(([name]) => name).join(", ")}.`);
    if (this.axis) this.update(this.axis);
  }

  private async load(): Promise<void> {
    const recipe = this.chosen();
    if (recipe && (await this.request({ do: "recipe", action: "load", name: recipe.name }))) this.operation.notice(`Recipe ${recipe.name} is loaded.`);
  }

  private ask(saves: boolean): void {
    this.saves = saves;
    const recipe = this.chosen();
    setText(byId("recipe-title"), saves ? "Save the present values as a recipe" : `Delete recipe ${recipe?.name ?? ""}`);
    byId("recipe-name-line").hidden = !saves;
    this.name.required = saves;
    this.name.value = saves ? (recipe?.name ?? "") : "";
    setText(byId("recipe-problem"), "");
    setText(byId("recipe-do"), saves ? "Save" : "Delete");
    this.describeSave();
    this.dialog.showModal();
  }

  private describeSave(): void {
    const same = this.axis?.setPoints.recipes.find((one) => one.name.toUpperCase() === this.name.value.trim().toUpperCase());
    setText(byId("recipe-text"), !this.saves ? "The values in use stay as they are." : same ? `This replaces recipe ${same.name}.` : `${this.axis?.setPoints.recipes.length ?? 0} of ${this.axis?.setPoints.room ?? 0} recipes are saved.`);
  }

  private async finish(): Promise<void> {
    const name = this.saves ? this.name.value.trim() : (this.chosen()?.name ?? "");
    const answer = await this.operation.wireAsk({ do: "recipe", action: this.saves ? "save" : "delete", name, crc: this.axis?.setPoints.crc });
    if (answer.result !== "done") return setText(byId("recipe-problem"), answer.text);
    this.dialog.close();
    this.operation.notice(`Recipe ${name} is ${this.saves ? "saved" : "deleted"}.`);
  }

  private async export(format: string): Promise<void> {
    const answer = await this.operation.ask({ do: "recipe", action: "export", format }, "export");
    if (answer.result === "done") saveFile(`${this.axis?.program?.symbols.program ?? this.axis?.info.name}_recipes.${format}`, answer.text, format === "csv" ? "text/csv" : "application/toml");
  }

  private openImport(): void {
    this.file.value = "";
    setText(byId("import-problem"), "");
    this.importer.showModal();
  }

  private async import(): Promise<void> {
    const file = this.file.files?.[0];
    if (!file) return setText(byId("import-problem"), "Choose a file first.");
    if (file.size > 32 * 1024) return setText(byId("import-problem"), `${file.name} is too long for recipes`);
    const format = /\.toml$/i.test(file.name) ? "toml" : "csv";
    const answer = await this.operation.wireAsk({ do: "recipe", action: "import", format, text: await file.text(), crc: this.axis?.setPoints.crc });
    if (answer.result !== "done") return setText(byId("import-problem"), `${file.name}: ${answer.text}`);
    this.importer.close();
    this.operation.notice(`${file.name}: ${answer.text}. Load one to use it.`);
  }
}

