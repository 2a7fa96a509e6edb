//! Names of functions with their packages.

use crate::image::Image;
use crate::value::Value;

/// A function name with the package of its symbol, as the printer shows generic functions.
pub fn qualified(image: &Image, name: &Value) -> String {
    match name {
        Value::Symbol(sym, ..) => match image.symbol(*sym).package {
            Some(package) => {
                let colons = match image.home_access(*sym) {
                    Some(crate::value::package::Access::External) => ":",
                    _ => "::",
                };
                let home = &image.packages.get(package).name;
                format!("{home}{colons}{}", image.name(*sym))
            }
            None => format!("#:{}", image.name(*sym)),
        },
        list => {
            let parts: Vec<String> = list
                .iter_list()
                .map(|part| match part {
                    Value::Symbol(crate::value::known::SETF, ..) => "SETF".to_owned(),
                    other => qualified(image, &other),
                })
                .collect();
            format!("({})", parts.join(" "))
        }
    }
}
