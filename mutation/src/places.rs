//! Which operators are changed, and the source with every change behind a switch.
//!
//! ```text
//! a + b    becomes    ({ let l7 = a; let r7 = b; if crate::switch::on(7) { l7 - r7 } else { l7 + r7 } })
//! ```
//!
//! Both sides are computed once, whichever operator is on, and the lines stay where they are, so that what the
//! compiler says of a line is said of its changes.

use std::ops::Range;
use std::path::{Path, PathBuf};

use syn::spanned::Spanned;
use syn::visit::{self, Visit};
use syn::{BinOp, Expr, UnOp};

use crate::Outcome;

/// One operator that can be another.
#[derive(Debug, Clone)]
pub struct Change {
    /// Its switch; the first is [`FIRST`].
    pub id: u32,
    pub file: PathBuf,
    /// Where the whole expression lies, bytes.
    whole: Range<usize>,
    /// Where the operator lies.
    operator: Range<usize>,
    kind: Kind,
    /// Lines of the whole expression, from 1.
    pub lines: Range<usize>,
    at: (usize, usize),
    pub line: String,
}

#[derive(Debug, Clone)]
enum Kind {
    /// Of two values, one of which comes out.
    Arithmetic(&'static str, &'static str),
    /// Of two values that are looked at.
    Comparison(&'static str, &'static str),
    /// `&&` and `||`.
    Both,
    Either,
    /// What changes its left side.
    Assign(&'static str, &'static str),
    Minus,
    Not,
}

/// The numbers below say that nothing is on.
pub const FIRST: u32 = 2;

impl Change {
    pub fn place(&self) -> String {
        let to = match self.kind {
            Kind::Arithmetic(from, to) | Kind::Comparison(from, to) | Kind::Assign(from, to) => {
                format!("{from} for {to}")
            }
            Kind::Both => "&& for ||".to_owned(),
            Kind::Either => "|| for &&".to_owned(),
            Kind::Minus => "- left out".to_owned(),
            Kind::Not => "! left out".to_owned(),
        };
        format!("{}:{}:{} {to}", self.file.display(), self.at.0, self.at.1)
    }
}

/// Every operator of the files below the named ones, or each so many-th.
pub fn find(copy: &Path, under: &[String], every: usize) -> Outcome<Vec<Change>> {
    let mut files = Vec::new();
    for name in under {
        collect(&copy.join(name), &mut files)?;
    }
    files.sort();
    let mut all = Vec::new();
    for file in files {
        let text =
            std::fs::read_to_string(&file).map_err(|e| format!("{}: {e}", file.display()))?;
        let parsed = syn::parse_file(&text).map_err(|e| format!("{}: {e}", file.display()))?;
        let short = file.strip_prefix(copy).unwrap_or(&file).to_owned();
        let lines = text.lines().map(str::to_owned).collect();
        let mut seen = Seen {
            file: short,
            lines,
            all: Vec::new(),
        };
        seen.visit_file(&parsed);
        all.append(&mut seen.all);
    }
    let mut kept: Vec<Change> = all.into_iter().step_by(every).collect();
    for (change, id) in kept.iter_mut().zip(FIRST..) {
        change.id = id;
    }
    Ok(kept)
}

fn collect(path: &Path, files: &mut Vec<PathBuf>) -> Outcome<()> {
    if path.is_dir() {
        let entries = std::fs::read_dir(path).map_err(|e| format!("{}: {e}", path.display()))?;
        for entry in entries {
            let entry = entry.map_err(|e| format!("{}: {e}", path.display()))?;
            collect(&entry.path(), files)?;
        }
        return Ok(());
    }
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let code = name.ends_with(".rs") && name != "tests.rs" && name != "testing.rs";
    if code {
        files.push(path.to_owned());
    }
    if path.exists() {
        Ok(())
    } else {
        Err(format!("{}: there is no such file", path.display()))
    }
}

struct Seen {
    file: PathBuf,
    lines: Vec<String>,
    all: Vec<Change>,
}

impl Seen {
    fn add(&mut self, whole: &Expr, operator: proc_macro2::Span, kind: Kind) {
        let (span, start) = (whole.span(), operator.start());
        self.all.push(Change {
            id: 0,
            file: self.file.clone(),
            whole: span.byte_range(),
            operator: operator.byte_range(),
            kind,
            lines: span.start().line..span.end().line + 1,
            at: (start.line, start.column + 1),
            line: self.lines.get(start.line - 1).cloned().unwrap_or_default(),
        });
    }
}

fn is_test(attributes: &[syn::Attribute]) -> bool {
    attributes.iter().any(|a| {
        let list = a.meta.require_list();
        a.path().is_ident("cfg") && list.is_ok_and(|l| l.tokens.to_string().contains("test"))
    })
}

/// Whether a condition binds names, which cannot be computed apart.
fn binds(expression: &Expr) -> bool {
    match expression {
        Expr::Let(_) => true,
        Expr::Binary(b) => binds(&b.left) || binds(&b.right),
        _ => false,
    }
}

impl<'s> Visit<'s> for Seen {
    // What is computed by the compiler cannot be switched.
    fn visit_item_const(&mut self, _: &'s syn::ItemConst) {}
    fn visit_impl_item_const(&mut self, _: &'s syn::ImplItemConst) {}
    fn visit_trait_item_const(&mut self, _: &'s syn::TraitItemConst) {}
    fn visit_item_static(&mut self, _: &'s syn::ItemStatic) {}
    fn visit_type(&mut self, _: &'s syn::Type) {}
    fn visit_generic_argument(&mut self, _: &'s syn::GenericArgument) {}
    fn visit_pat(&mut self, _: &'s syn::Pat) {}
    fn visit_expr_const(&mut self, _: &'s syn::ExprConst) {}
    fn visit_expr_repeat(&mut self, repeat: &'s syn::ExprRepeat) {
        self.visit_expr(&repeat.expr);
    }
    fn visit_item_mod(&mut self, module: &'s syn::ItemMod) {
        if !is_test(&module.attrs) {
            visit::visit_item_mod(self, module);
        }
    }
    fn visit_item_fn(&mut self, function: &'s syn::ItemFn) {
        if function.sig.constness.is_none() && !is_test(&function.attrs) {
            visit::visit_item_fn(self, function);
        }
    }
    fn visit_impl_item_fn(&mut self, function: &'s syn::ImplItemFn) {
        if function.sig.constness.is_none() && !is_test(&function.attrs) {
            visit::visit_impl_item_fn(self, function);
        }
    }

    fn visit_expr(&mut self, expression: &'s Expr) {
        match expression {
            Expr::Binary(b) => {
                let kind = match b.op {
                    BinOp::Add(_) => Some(Kind::Arithmetic("+", "-")),
                    BinOp::Sub(_) => Some(Kind::Arithmetic("-", "+")),
                    BinOp::Mul(_) => Some(Kind::Arithmetic("*", "/")),
                    BinOp::Div(_) => Some(Kind::Arithmetic("/", "*")),
                    BinOp::Lt(_) => Some(Kind::Comparison("<", "<=")),
                    BinOp::Le(_) => Some(Kind::Comparison("<=", "<")),
                    BinOp::Gt(_) => Some(Kind::Comparison(">", ">=")),
                    BinOp::Ge(_) => Some(Kind::Comparison(">=", ">")),
                    BinOp::Eq(_) => Some(Kind::Comparison("==", "!=")),
                    BinOp::Ne(_) => Some(Kind::Comparison("!=", "==")),
                    BinOp::And(_) if !binds(expression) => Some(Kind::Both),
                    BinOp::Or(_) => Some(Kind::Either),
                    BinOp::AddAssign(_) => Some(Kind::Assign("+=", "-=")),
                    BinOp::SubAssign(_) => Some(Kind::Assign("-=", "+=")),
                    BinOp::MulAssign(_) => Some(Kind::Assign("*=", "/=")),
                    BinOp::DivAssign(_) => Some(Kind::Assign("/=", "*=")),
                    _ => None,
                };
                if let Some(kind) = kind {
                    self.add(expression, b.op.span(), kind);
                }
            }
            Expr::Unary(u) => match u.op {
                UnOp::Neg(minus) => self.add(expression, minus.span(), Kind::Minus),
                UnOp::Not(not) => self.add(expression, not.span(), Kind::Not),
                _ => {}
            },
            _ => {}
        }
        visit::visit_expr(self, expression);
    }
}

/// The text of a file with the changes of it behind their switches.
pub fn switched(text: &str, changes: &[&Change]) -> String {
    // What is put at a place: closing before opening, of several that open the outer first, of several that
    // close the inner first. The changes come with the outer before the inner.
    let mut edits: Vec<(usize, u8, i64, usize, String)> = Vec::new();
    for (depth, change) in (0_i64..).zip(changes) {
        let id = change.id;
        let (start, middle, end) = match change.kind {
            Kind::Arithmetic(from, to) => (
                format!("({{ let l{id} = "),
                format!("; let r{id} = "),
                format!(
                    "; if crate::switch::on({id}) {{ l{id} {to} r{id} }} else {{ l{id} {from} r{id} }} }})"
                ),
            ),
            Kind::Comparison(from, to) => (
                format!("({{ let l{id} = &("),
                format!("); let r{id} = &("),
                format!(
                    "); if crate::switch::on({id}) {{ l{id} {to} r{id} }} else {{ l{id} {from} r{id} }} }})"
                ),
            ),
            // l && r is r where l holds; l || r is r where it does not.
            Kind::Both => (
                format!("({{ let l{id} = "),
                format!("; let o{id} = crate::switch::on({id}); if l{id} != o{id} {{ "),
                format!(" }} else {{ o{id} }} }})"),
            ),
            Kind::Either => (
                format!("({{ let l{id} = "),
                format!("; let o{id} = !crate::switch::on({id}); if l{id} != o{id} {{ "),
                format!(" }} else {{ o{id} }} }})"),
            ),
            // The changed one is a copy without switches of its own: both would borrow the left side.
            Kind::Assign(_, to) => {
                let one_line = |range: Range<usize>| text[range].replace('\n', " ");
                let left = one_line(change.whole.start..change.operator.start);
                let right = one_line(change.operator.end..change.whole.end);
                (
                    format!("{{ if crate::switch::on({id}) {{ {left}{to}{right} }} else {{ "),
                    text[change.operator.clone()].to_owned(),
                    " } }".to_owned(),
                )
            }
            Kind::Minus => (
                format!("({{ let u{id} = "),
                String::new(),
                format!("; if crate::switch::on({id}) {{ u{id} }} else {{ -u{id} }} }})"),
            ),
            Kind::Not => (
                "((".to_owned(),
                String::new(),
                format!(") == crate::switch::on({id}))"),
            ),
        };
        edits.push((change.whole.start, 1, depth, 0, start));
        edits.push((
            change.operator.start,
            2,
            depth,
            change.operator.len(),
            middle,
        ));
        edits.push((change.whole.end, 0, -depth, 0, end));
    }
    edits.sort_by_key(|a| (a.0, a.1, a.2));
    let (mut out, mut from) = (String::with_capacity(2 * text.len()), 0);
    for (at, _, _, left_out, instead) in edits {
        out.push_str(&text[from..at]);
        out.push_str(&instead);
        from = at + left_out;
    }
    out.push_str(&text[from..]);
    out
}
